"""Places where captures are cut: found locally, and right wherever a decoder began."""

from itertools import pairwise
from pathlib import Path

import pytest
from busservo import (
    ActionGroupStop,
    Direction,
    Message,
    Noise,
    ServoMove,
    ServoUnload,
    StreamDecoder,
)
from busservo.tables import safe_cuts
from framewire.tables.archive import cuts
from hypothesis import given
from hypothesis import strategies as st

from tests.strategies import DIRECTIONS, directions, joined, lines, read
from tests.unit.runtime.tables.conversations import conversation

LARGEST = 257
STOP = ActionGroupStop().encode()
# Some are larger than the windows in which places are looked for.
captures = st.builds(
    lambda parts, times: b"".join(parts) * times,
    st.lists(lines, min_size=1, max_size=4),
    st.sampled_from([1, 1, 2, 40]),
)
sizes = st.sampled_from([1, 7, 30, 200])


def events_of(parts: list[bytes], direction: Direction | None) -> list[Message | Noise]:
    """Return the events of parts, each of a decoder of its own."""
    return [event for part in parts for event in joined(read(direction, [part]))]


def pieces_of(capture: bytes, places: list[int]) -> list[bytes]:
    return [capture[start:end] for start, end in pairwise([0, *places, len(capture)])]


@pytest.fixture(params=["judged", "tried"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Find places as in protocols that are searched at once, and as in all others."""
    if request.param == "tried":
        monkeypatch.setattr(cuts, "frames_on", lambda _codec, _direction: None)


def _holds(capture: bytes, size: int, direction: Direction | None) -> None:
    places = safe_cuts(capture, size, direction=direction)
    assert events_of(pieces_of(capture, places), direction) == joined(read(direction, [capture]))


@given(captures, sizes, directions)
def test_the_pieces_have_the_events_of_the_whole(
    capture: bytes, size: int, direction: Direction | None
) -> None:
    _holds(capture, size, direction)


@given(lines, directions)
def test_so_they_have_for_protocols_that_are_not_searched_at_once(
    line: bytes, direction: Direction | None
) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cuts, "frames_on", lambda _codec, _direction: None)
        _holds(line, 1, direction)


@given(captures, sizes, directions, st.data())
def test_a_decoder_that_began_anywhere_in_front_holds_nothing_there(
    capture: bytes, size: int, direction: Direction | None, data: st.DataObject
) -> None:
    places = safe_cuts(capture, size, direction=direction)
    if not places:
        return
    place = data.draw(st.sampled_from(places))
    # The frame that ends there is the last that must be whole.
    (*_, last) = StreamDecoder(direction).feed(capture[:place])
    assert not isinstance(last, Noise)
    begin = data.draw(st.integers(0, place - len(last.encode())))
    decoder = StreamDecoder(direction)
    events = decoder.feed(capture[begin:place])
    assert (decoder.pending, events[-1]) == (0, last)


MOVE = ServoMove(time_ms=1000, targets=[(1, 500)]).encode()


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_every_end_of_a_frame_among_frames_is_a_safe_place(direction: Direction | None) -> None:
    frame = STOP if direction is not Direction.CONTROLLER_TO_HOST else b"\x55\x55\x04\x0f\x10\x27"
    assert safe_cuts(frame * 5, 1, direction=direction) == [len(frame) * n for n in range(1, 5)]


@pytest.mark.usefixtures("way")
def test_no_place_is_behind_noise_or_what_waits() -> None:
    assert safe_cuts(b"\x00" * 5000, 1) == []
    assert safe_cuts(b"\x55" * 5000, 1) == []
    # The header in front waits for more bytes than the frame behind it has.
    waiting = bytes.fromhex("55 55 FE 03 53")
    assert safe_cuts(waiting + STOP + bytes(3), 1) == []


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
    assert first == next(
        len(around) + len(STOP) * number
        for number in range(1, 100)
        if len(around) + len(STOP) * (number - 1) >= waits_until
    )


@pytest.mark.usefixtures("way")
def test_places_are_as_far_apart_as_asked_for() -> None:
    capture = conversation(400)
    places = safe_cuts(capture, 1000)
    assert len(places) == pytest.approx(len(capture) / 1000, abs=2)
    assert all(1000 <= end - start < 1000 + LARGEST for start, end in pairwise([0, *places]))


def test_behind_noise_the_first_place_is_taken() -> None:
    capture = STOP * 10 + bytes(5000) + STOP * 500
    (first, *_) = safe_cuts(capture, 1500)
    assert first == 5040 + len(STOP)


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


@pytest.mark.parametrize("size", [0, -1])
def test_a_piece_has_a_size(size: int) -> None:
    with pytest.raises(ValueError, match=f"size is {size}, and a piece has at least 1 byte"):
        safe_cuts(b"", size)


def test_a_capture_without_bytes_is_not_cut() -> None:
    assert safe_cuts(b"", 1) == []
    assert safe_cuts(STOP, 1) == []


def test_a_file_that_is_not_there_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        safe_cuts(tmp_path / "absent.bin", 1)
