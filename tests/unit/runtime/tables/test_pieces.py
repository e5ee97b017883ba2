"""Pieces of captures: how they are found by name, read one by one, and cut where it is safe."""

import os
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path

import pyarrow as pa
import pytest
from busservo import ActionGroupStop, Direction, ServoMove, ServoUnload, StreamDecoder
from busservo.recordings import RecordingError
from busservo.tables import Piece, read, safe_cuts, scan
from framewire.tables.archive import cuts
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.strategies import DIRECTIONS, directions, joined, lines
from tests.strategies import read as decoded
from tests.unit.runtime.tables.conversations import conversation

CAPTURE = conversation(100)


def written(folder: Path, files: Iterable[str], data: bytes = CAPTURE) -> None:
    for name in files:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


@pytest.fixture
def line(tmp_path: Path) -> Path:
    """Return a capture, alone in its folder."""
    written(tmp_path, ["line.bin"])
    return tmp_path / "line.bin"


def captures_of(pieces: Iterable[Piece]) -> list[str]:
    return [piece.capture for piece in pieces]


@in_turn("direction", lambda: [*Direction, None])
@in_turn("size", lambda: [100, 10_000_000])
def test_pieces_together_are_the_tables(direction: Direction | None, size: int, line: Path) -> None:
    pieces = scan(line.parent, size=size, direction=direction)
    starts = [piece.start for piece in pieces]
    assert [pieces[0].start, *(piece.end for piece in pieces)] == [*starts, len(CAPTURE)]
    assert (len(pieces) > 1) is (size < len(CAPTURE))
    parts = [piece.read() for piece in pieces]
    for name, table in read(CAPTURE, direction=direction).items():
        assert pa.concat_tables(part[name] for part in parts).to_pylist() == table.to_pylist()


# --- What is scanned -----------------------------------------------------------------------------
TREE = ["b.bin", "a/line.bin", "a/other.bin", "a/deep/line.bin", "c/line.bin"]
IN_ORDER = ["a/deep/line.bin", "a/line.bin", "a/other.bin", "b.bin", "c/line.bin"]


def test_a_folder_is_all_files_in_it_in_order(tmp_path: Path) -> None:
    # But for what is hidden, and for datasets.
    written(tmp_path, [*TREE, ".hidden", ".git/line.bin", "dataset/_pieces/x", "dataset/T/x"])
    assert captures_of(scan(tmp_path)) == IN_ORDER
    assert captures_of(scan(f"{tmp_path}{os.sep}")) == IN_ORDER


@in_turn(
    "names, found",
    lambda: [
        # What fits a pattern.
        (["*/line.bin"], ["a/line.bin", "c/line.bin"]),
        (["a/*.bin"], ["line.bin", "other.bin"]),
        (["**/line.bin"], ["a/deep/line.bin", "a/line.bin", "c/line.bin"]),
        # Captures of one name are told apart, and one that is named twice is one.
        (["c", "a/line.bin"], ["c/line.bin", "a/line.bin"]),
        (["a/line.bin"], ["line.bin"]),
        (["a", "a/line.bin", "a/*.bin"], ["deep/line.bin", "line.bin", "other.bin"]),
        # A file, if there is one, though its name has the signs of a pattern.
        (["line[1].bin"], ["line[1].bin"]),
    ],
)
def test_captures_are_told_apart(names: list[str], found: list[str], tmp_path: Path) -> None:
    written(tmp_path, [*TREE, "line[1].bin", "line1.bin"])
    assert captures_of(scan([str(tmp_path / name) for name in names])) == found
    if len(names) == 1:
        assert captures_of(scan(tmp_path / names[0])) == found


def test_an_unreadable_file_says_so_as_a_piece(line: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def denied(path: Path, *_: object, **_named: object) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(type(line), "open", denied)
    (piece,) = scan(line.parent)
    assert (piece.capture, piece.size, piece.stamp) == ("line.bin", 0, None)
    with pytest.raises(PermissionError):
        piece.read()


# Where a link in the folder that is scanned stands and leads to, and what is found: by the folder,
# and by a pattern.
LINKS = {
    "its own folder": ("again", ".", [], []),
    "a folder beside the file": ("b", "a", [], ["b/line.bin"]),
    "the folder above": ("a/up", "..", [], []),
    "a folder outside": ("a", "../outside", [], []),
    "a file in the folder": ("other.bin", "a/line.bin", ["other.bin"], []),
    "a file outside": ("a/other.bin", "../../outside/line.bin", [], []),
    "a file outside by a link inside": ("a/other.bin", "../b.bin", [], []),
    "itself": ("a/loop.bin", "loop.bin", ["a/loop.bin"], []),
    "nowhere": ("a/gone.bin", "absent", ["a/gone.bin"], []),
}


@pytest.mark.parametrize("name", LINKS)
def test_links_are_followed_to_files_within_what_is_scanned(name: str, tmp_path: Path) -> None:
    place, target, by_folder, by_pattern = LINKS[name]
    written(tmp_path, ["in/a/line.bin", "outside/line.bin"])
    if place == "a":
        (tmp_path / "in" / "a" / "line.bin").unlink()
        (tmp_path / "in" / "a").rmdir()
    elif target == "../b.bin":
        (tmp_path / "in" / "b.bin").symlink_to("../outside/line.bin")
    (tmp_path / "in" / place).symlink_to(target)
    own = [] if place == "a" else ["a/line.bin"]
    assert captures_of(scan(tmp_path / "in")) == sorted(own + by_folder)
    found = captures_of(scan(tmp_path / "in" / "*" / "line.bin"))
    assert found == sorted(own + by_pattern or ["*/line.bin"])


def test_a_link_that_is_named_is_followed(tmp_path: Path) -> None:
    written(tmp_path, ["outside/line.bin"])
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "line.bin").symlink_to("../outside/line.bin")
    (tmp_path / "in" / "folder").symlink_to("../outside")
    assert captures_of(scan(tmp_path / "in" / "line.bin")) == ["line.bin"]
    assert captures_of(scan(tmp_path / "in" / "folder")) == ["line.bin"]
    assert scan(tmp_path / "in") == []


def test_nothing_is_no_piece_and_another_form_is_refused(tmp_path: Path) -> None:
    assert scan(tmp_path) == scan([]) == []
    written(tmp_path, ["line.bin"])
    with pytest.raises(ValueError, match="'csv' is none of the forms"):
        scan(tmp_path, form="csv")


def test_a_file_that_changes_while_it_is_read_is_not_taken_for_what_it_was(line: Path) -> None:
    (piece,) = scan(line)
    batches = piece.read_batches(block=100)
    assert next(batches)
    line.write_bytes(CAPTURE + b"\x00")
    with pytest.raises(RecordingError, match="changed"):
        list(batches)


# --- Safe places to cut --------------------------------------------------------------------------
LARGEST = 257
STOP = ActionGroupStop().encode()
# Some are larger than the windows in which places are looked for.
captures = st.builds(
    lambda parts, times: b"".join(parts) * times,
    st.lists(lines, min_size=1, max_size=4),
    st.sampled_from([1, 1, 2, 40]),
)
sizes = st.sampled_from([1, 7, 30, 200])


@pytest.fixture(params=["judged", "tried"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Find places as in protocols that are searched at once, and as in all others."""
    if request.param == "tried":
        monkeypatch.setattr(cuts, "frames_on", lambda _codec, _direction: None)


def holds(capture: bytes, size: int, direction: Direction | None) -> None:
    """Assert that the pieces of a capture, each for itself, have the events of the whole."""
    places = [0, *safe_cuts(capture, size, direction=direction), len(capture)]
    parts = [joined(decoded(direction, [capture[at:end]])) for at, end in pairwise(places)]
    assert [event for part in parts for event in part] == joined(decoded(direction, [capture]))


@given(captures, sizes, directions)
def test_pieces_hold_all_events(capture: bytes, size: int, direction: Direction | None) -> None:
    holds(capture, size, direction)


MOVE = ServoMove(time_ms=1000, targets=[(1, 500)]).encode()


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_every_end_of_a_frame_among_frames_is_a_safe_place(direction: Direction | None) -> None:
    frame = STOP if direction is not Direction.CONTROLLER_TO_HOST else b"\x55\x55\x04\x0f\x10\x27"
    assert safe_cuts(frame * 5, 1, direction=direction) == [len(frame) * n for n in range(1, 5)]


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("shared", [1, 2])
def test_no_place_is_behind_a_frame_that_begins_in_another(shared: int) -> None:
    unload = ServoUnload([1] * (252 - shared) + [0x55] * shared).encode()
    assert len(unload) == LARGEST
    in_front = STOP * 100 + unload + STOP[shared:]
    capture = in_front + bytes(3) + STOP * 5
    assert StreamDecoder(None).feed(capture[: len(in_front)])[-1] != ActionGroupStop()
    assert safe_cuts(capture, len(in_front))[0] == len(in_front) + 3 + len(STOP)


@pytest.mark.usefixtures("way")
def test_a_decoder_that_begins_in_a_frame_may_wait_for_more() -> None:
    # In the frame stand a frame and the beginning of a large one.
    around = bytes.fromhex("55 55 0E 03 03 00 00 55 55 02 07 55 55 FB 03 52")
    waits_until = 11 + 0xFB + 2
    capture = around + STOP * 100
    assert len(StreamDecoder(None).feed(capture)) == 101
    (first, *_) = safe_cuts(capture, len(around) + 1)
    ends = range(len(around), len(capture), len(STOP))
    assert first == next(end for end in ends if end - len(STOP) >= waits_until)


def test_a_place_is_found_by_the_bytes_around_it(tmp_path: Path) -> None:
    file = tmp_path / "sparse.bin"
    with file.open("wb") as stream:
        stream.truncate(1 << 42)
        for at in (1 << 40, 3 << 40):
            stream.seek(at)
            stream.write(MOVE * 100)
    # To read all of these 4 TB would take hours.
    first = (1 << 40) + len(MOVE)
    assert safe_cuts(file, 1 << 40) == [first, (3 << 40) + len(MOVE)]


def test_what_cannot_be_cut_is_not(tmp_path: Path) -> None:
    assert safe_cuts(b"", 1) == safe_cuts(STOP, 1) == []
    for size in (0, -1):
        with pytest.raises(ValueError, match=f"size is {size}, and a piece has at least 1 byte"):
            safe_cuts(b"", size)
    with pytest.raises(FileNotFoundError):
        safe_cuts(tmp_path / "absent.bin", 1)
