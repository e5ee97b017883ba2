"""Of the frames that some bytes may begin, the longest counts: a message reads as itself."""

from collections.abc import Iterable
from typing import Any

import pytest
from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model.codec import NotAFrame, decode
from framegen.model.model import derive
from framegen.model.stream import Event, ReferenceDecoder

from tests.factories import Data, small_spec
from tests.in_turn import in_turn


def message(length: int, fields: str, **said: Any) -> Data:
    """Return a message of a sensor, with fields such as `level: u8`."""
    typed = (each.split(": ") for each in fields.split(", "))
    declared = {name: {"type": kind, "about": "A number."} for name, kind in typed}
    facts = {"direction": "sensor -> host", "summary": "A report.", "cite": "manual"}
    return {**facts, "length": length, "fields": declared, "examples": [], **said}


def checked(*covers: str) -> Data:
    return {"is": "checksum", "type": "u8", "method": "xor", "covers": [*covers]}


def line_of(frame: Data, messages: Data) -> ReferenceDecoder:
    data = small_spec("summed", frame, messages, ends="host sensor", byte_order="big")
    return ReferenceDecoder(derive(Spec.model_validate(data)), [Direction("sensor", "host")])


def named(events: Iterable[Event]) -> list[tuple[str, bytes]]:
    return [(event.message.name if event.message else event.kind, event.data) for event in events]


# Only its checksum tells how long a frame is; the larger message comes first.
KIND, BODY = {"is": "id", "type": "u8"}, {"is": "body"}
BARE = {"kind": KIND, "body": BODY, "sum": checked("kind", "body")}
TWO_SIZES = {"Wide": message(4, "level: u16", id=1), "Narrow": message(3, "level: u8", id=1)}
# All four bytes are a frame of the larger one, and the first three one of the smaller.
BOTH = bytes.fromhex("01 05 04 00")


@pytest.fixture
def line() -> ReferenceDecoder:
    return line_of(BARE, TWO_SIZES)


def test_a_frame_is_the_message_that_fits_exactly(line: ReferenceDecoder) -> None:
    way = line.directions[0]
    assert decode(line.model, way, BOTH).layout.name == "Wide"
    assert decode(line.model, way, BOTH[:3]).layout.name == "Narrow"
    with pytest.raises(NotAFrame) as raised:
        decode(line.model, way, BOTH[:3] + b"\1")
    assert (raised.value.reason, raised.value.offset) == ("trailing bytes", 3)


def test_a_smaller_one_is_held_while_the_longer_may_come(line: ReferenceDecoder) -> None:
    narrow = [("Narrow", BOTH[:3])]
    assert named(line.decode_so_far(BOTH)) == [("Wide", BOTH)]
    assert line.decode_so_far(BOTH[:3]) == []
    assert named(line.decode(BOTH[:3])) == narrow
    # It comes as soon as the longer cannot, or as there is no room for it.
    assert named(line.decode_so_far(BOTH[:3] + b"\1")) == narrow
    small = ReferenceDecoder(line.model, line.directions, max_frame=3)
    assert named(small.decode_so_far(BOTH[:3])) == narrow


def test_what_is_no_smaller_frame_may_be_a_larger_one(line: ReferenceDecoder) -> None:
    data = bytes.fromhex("01 05 06 02")
    assert named(line.decode(data)) == [("Wide", data)]


# The same bytes may be a message of one kind of frame, and of an unknown id in another, whose
# length and checksum prove that it is a frame.
LENGTH = {"is": "length", "type": "u8", "counts": ["kind", "length", "body", "sum"]}
SIZED = {"kind": KIND, "length": LENGTH, "body": BODY, "sum": checked("kind", "length", "body")}
OF_TWO_KINDS = {
    "Sized": message(4, "level: u8", frame="sized", id=2),
    "Wide": message(5, "level: u16, more: u8", frame="bare", id=1),
    "Narrow": message(3, "level: u8", frame="bare", id=3),
}


@in_turn(
    "data, read",
    lambda: [
        # The first three bytes alone are proven, too; the message is longer.
        ("01 03 02 04 04", [("Wide", "01 03 02 04 04")]),
        ("01 03 02 04 05", [("unknown", "01 03 02"), ("noise", "04 05")]),
        # Both are of three bytes, and what is known comes first.
        ("03 03 00", [("Narrow", "03 03 00")]),
        # The frame of unknown id is longer.
        ("03 05 06 01 01", [("unknown", "03 05 06 01 01")]),
        ("03 05 06 01 02", [("Narrow", "03 05 06"), ("noise", "01 02")]),
    ],
)
def test_an_unknown_frame_counts_as_long_as_it_is(data: str, read: list[tuple[str, str]]) -> None:
    line = line_of({"sized": SIZED, "bare": BARE}, OF_TWO_KINDS)
    found = [(name, piece.hex(" ")) for name, piece in named(line.decode(bytes.fromhex(data)))]
    assert found == read
