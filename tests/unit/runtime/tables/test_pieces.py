"""Pieces of captures: found by names, patterns and folders, and read one by one."""

import os
import pickle
from collections.abc import Iterable
from pathlib import Path

import pyarrow as pa
import pytest
from busservo import Direction
from busservo.recordings import RecordingError
from busservo.tables import NOISE, Piece, read, read_batches, scan

from tests.unit.runtime.tables.conversations import conversation, recorded

CAPTURE = conversation(100)


def written(folder: Path, files: Iterable[str], data: bytes = CAPTURE) -> None:
    for name in files:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def captures_of(pieces: Iterable[Piece]) -> list[str]:
    return [piece.capture for piece in pieces]


@pytest.mark.parametrize("direction", [*Direction, None])
@pytest.mark.parametrize("size", [100, 10_000_000])
def test_the_pieces_of_a_capture_are_its_tables(
    direction: Direction | None, size: int, tmp_path: Path
) -> None:
    (tmp_path / "line.bin").write_bytes(CAPTURE)
    pieces = scan(tmp_path, size=size, direction=direction)
    assert [pieces[0].start, *(piece.end for piece in pieces)] == [
        *(piece.start for piece in pieces),
        len(CAPTURE),
    ]
    assert (len(pieces) > 1) is (size < len(CAPTURE))
    whole = read(CAPTURE, direction=direction)
    parts = [piece.read() for piece in pieces]
    for name, table in whole.items():
        assert pa.concat_tables(part[name] for part in parts).to_pylist() == table.to_pylist()


def test_a_piece_is_read_in_blocks_with_the_offsets_of_the_capture(tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(CAPTURE)
    for piece in scan(tmp_path, size=1500)[1:-1]:
        batches = [*piece.read_batches(block=100)]
        assert len(batches) > 1
        tables = [batch for made in batches for batch in made.values()]
        offsets = [offset for batch in tables for offset in batch["offset"].to_pylist()]
        assert piece.start <= min(offsets) <= max(offsets) < piece.end


def test_a_recording_is_one_piece_with_its_times(tmp_path: Path) -> None:
    (tmp_path / "line.hex").write_text(recorded(30), encoding="utf-8")
    (piece,) = scan(tmp_path / "line.hex", size=100)
    assert (piece.start, piece.end, piece.form) == (0, len(recorded(30)), "hex")
    assert dict(piece.read()) == dict(read(recorded(30).encode()))


def test_hex_may_be_meant_as_raw_bytes(tmp_path: Path) -> None:
    (tmp_path / "line").write_bytes(b"55 55 02 07")
    (piece,) = scan(tmp_path / "line", form="raw")
    assert piece.read()[NOISE].num_rows == 1


def test_an_empty_file_is_a_piece_of_nothing(tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(b"")
    (piece,) = scan(tmp_path)
    assert piece.size == 0
    assert piece.read().filled == {}


def test_a_piece_may_be_sent_to_another_process(tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(CAPTURE)
    pieces = scan(tmp_path, size=1000, direction=Direction.HOST_TO_CONTROLLER)
    assert pickle.loads(pickle.dumps(pieces)) == pieces  # noqa: S301


# --- What is scanned -----------------------------------------------------------------------------

TREE = ["b.bin", "a/line.bin", "a/other.bin", "a/deep/line.bin", "c/line.bin"]
IN_ORDER = ["a/deep/line.bin", "a/line.bin", "a/other.bin", "b.bin", "c/line.bin"]


def test_a_folder_is_all_files_in_it_in_order(tmp_path: Path) -> None:
    written(tmp_path, TREE)
    assert captures_of(scan(tmp_path)) == IN_ORDER
    assert captures_of(scan(f"{tmp_path}{os.sep}")) == IN_ORDER


def test_hidden_files_and_datasets_are_no_captures(tmp_path: Path) -> None:
    written(tmp_path, [*TREE, ".hidden", ".git/line.bin", "dataset/_pieces/x", "dataset/T/x"])
    assert captures_of(scan(tmp_path)) == IN_ORDER


def test_a_pattern_is_the_files_that_it_fits(tmp_path: Path) -> None:
    written(tmp_path, TREE)
    found = captures_of(scan(tmp_path / "*" / "line.bin"))
    assert found == ["a/line.bin", "c/line.bin"]
    assert captures_of(scan(tmp_path / "a" / "*.bin")) == ["line.bin", "other.bin"]
    assert captures_of(scan(str(tmp_path / "**" / "line.bin"))) == [
        "a/deep/line.bin",
        "a/line.bin",
        "c/line.bin",
    ]


def test_captures_of_one_name_are_told_apart(tmp_path: Path) -> None:
    written(tmp_path, TREE)
    found = scan([tmp_path / "c", tmp_path / "a" / "line.bin"])
    assert captures_of(found) == ["c/line.bin", "a/line.bin"]
    assert captures_of(scan(tmp_path / "a" / "line.bin")) == ["line.bin"]


def test_a_file_that_is_named_twice_is_one_capture(tmp_path: Path) -> None:
    written(tmp_path, TREE)
    again = scan([tmp_path / "a", tmp_path / "a" / "line.bin", tmp_path / "a" / "*.bin"])
    assert captures_of(again) == ["deep/line.bin", "line.bin", "other.bin"]


def test_a_name_with_the_signs_of_a_pattern_is_a_file_if_there_is_one(tmp_path: Path) -> None:
    written(tmp_path, ["line[1].bin", "line1.bin"])
    assert captures_of(scan(tmp_path / "line[1].bin")) == ["line[1].bin"]


@pytest.mark.parametrize("name", ["absent.bin", "*.absent"])
def test_what_is_not_there_is_a_piece_that_says_so(name: str, tmp_path: Path) -> None:
    written(tmp_path, ["line.bin"])
    (piece, there) = scan([tmp_path / name, tmp_path / "line.bin"])
    assert (piece.capture, piece.size) == (name, 0)
    with pytest.raises(FileNotFoundError):
        piece.read()
    assert there.read().filled


def test_a_link_to_nowhere_is_a_piece_that_says_so(tmp_path: Path) -> None:
    (tmp_path / "link.bin").symlink_to(tmp_path / "absent")
    (piece,) = scan(tmp_path)
    with pytest.raises(FileNotFoundError):
        piece.read()


def test_a_file_that_cannot_be_read_is_a_piece_that_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def denied(path: Path, *_: object, **_named: object) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    written(tmp_path, ["line.bin"])
    monkeypatch.setattr(type(tmp_path), "open", denied)
    (piece,) = scan(tmp_path)
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


def test_nothing_is_no_piece(tmp_path: Path) -> None:
    assert scan(tmp_path) == scan([]) == []


def test_a_file_that_has_changed_is_not_read(tmp_path: Path) -> None:
    written(tmp_path, ["line.bin"])
    (piece, *_) = scan(tmp_path, size=1000)
    written(tmp_path, ["line.bin"], CAPTURE + b"\x00")
    with pytest.raises(RecordingError, match="changed since it was scanned: scan again"):
        # Before any of it is shown.
        next(piece.read_batches())


def test_a_file_that_changes_while_it_is_read_is_not_taken_for_what_it_was(tmp_path: Path) -> None:
    written(tmp_path, ["line.bin"])
    (piece,) = scan(tmp_path)
    batches = piece.read_batches(block=100)
    assert next(batches)
    written(tmp_path, ["line.bin"], CAPTURE + b"\x00")
    with pytest.raises(RecordingError, match="changed"):
        list(batches)


def test_another_form_is_refused(tmp_path: Path) -> None:
    written(tmp_path, ["line.bin"])
    with pytest.raises(ValueError, match="'csv' is none of the forms"):
        scan(tmp_path, form="csv")
    assert [*read_batches(b"")] == []
