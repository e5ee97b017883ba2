"""Of the frames that some bytes may begin, the longest counts: a message reads as itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model.codec import NotAFrame, decode
from framegen.model.model import derive
from framegen.model.stream import Event, ReferenceDecoder

if TYPE_CHECKING:
    from collections.abc import Iterable


def message(**said: Any) -> dict[str, Any]:
    """Return a message of a sensor."""
    facts = {"direction": "sensor -> host", "summary": "A report.", "cite": "manual"}
    return {**facts, "examples": [], **said}


def number(type_: str) -> dict[str, str]:
    """Return a field."""
    return {"type": type_, "about": "A number."}


# Only its checksum tells how long a frame is; the larger message comes first.
SUMMED = {
    "framegen": 2,
    "protocol": {
        "name": "summed",
        "title": "Summed",
        "version": "1.0.0",
        "authority": "manual",
        "summary": "Reports of two sizes.",
    },
    "sources": {"manual": {"title": "A manual", "kind": "document"}},
    "endpoints": {"host": "Listens.", "sensor": "Reports."},
    "link": {"baud": 9600},
    "byte_order": "big",
    "frame": {
        "kind": {"is": "id", "type": "u8", "about": "What it is."},
        "body": {"is": "body", "about": "The fields."},
        "sum": {
            "is": "checksum",
            "type": "u8",
            "method": "xor",
            "covers": ["kind", "body"],
            "about": "All of them combined.",
        },
    },
    "messages": {
        "Wide": message(id=1, length=4, fields={"level": number("u16")}),
        "Narrow": message(id=1, length=3, fields={"level": number("u8")}),
    },
}


# All four bytes are a frame of the larger one, and the first three one of the smaller.
BOTH = bytes.fromhex("01 05 04 00")


@pytest.fixture
def line() -> ReferenceDecoder:
    return ReferenceDecoder(derive(Spec.model_validate(SUMMED)), [Direction("sensor", "host")])


def named(events: Iterable[Event]) -> list[tuple[str, bytes]]:
    return [(event.message.name if event.message else event.kind, event.data) for event in events]


def test_a_frame_is_the_message_that_fits_exactly(line: ReferenceDecoder) -> None:
    way = line.directions[0]
    assert decode(line.model, way, BOTH).layout.name == "Wide"
    assert decode(line.model, way, BOTH[:3]).layout.name == "Narrow"


def test_one_that_fits_in_part_is_refused_behind_it(line: ReferenceDecoder) -> None:
    with pytest.raises(NotAFrame) as raised:
        decode(line.model, line.directions[0], BOTH[:3] + b"\1")
    assert (raised.value.reason, raised.value.offset) == ("trailing bytes", 3)


def test_a_stream_has_the_longest(line: ReferenceDecoder) -> None:
    assert named(line.decode_so_far(BOTH)) == [("Wide", BOTH)]


def test_a_smaller_one_is_held_while_the_longer_may_come(line: ReferenceDecoder) -> None:
    assert line.decode_so_far(BOTH[:3]) == []
    assert named(line.decode(BOTH[:3])) == [("Narrow", BOTH[:3])]


def test_it_comes_as_soon_as_the_longer_cannot(line: ReferenceDecoder) -> None:
    assert named(line.decode_so_far(BOTH[:3] + b"\1")) == [("Narrow", BOTH[:3])]


def test_what_is_no_smaller_frame_may_be_a_larger_one(line: ReferenceDecoder) -> None:
    data = bytes.fromhex("01 05 06 02")
    assert named(line.decode(data)) == [("Wide", data)]


def test_no_longer_one_is_awaited_than_there_is_room_for(line: ReferenceDecoder) -> None:
    small = ReferenceDecoder(line.model, line.directions, max_frame=3)
    assert named(small.decode_so_far(BOTH[:3])) == [("Narrow", BOTH[:3])]


# The same bytes may be a message of one kind of frame, and of an unknown id in another, whose
# length and checksum prove that it is a frame.
TWO_KINDS = {
    **{key: said for key, said in SUMMED.items() if key != "frame"},
    "frames": {
        "sized": {
            "kind": {"is": "id", "type": "u8", "about": "What it is."},
            "length": {
                "is": "length",
                "type": "u8",
                "counts": ["kind", "length", "body", "sum"],
                "about": "How many bytes.",
            },
            "body": {"is": "body", "about": "The fields."},
            "sum": {
                "is": "checksum",
                "type": "u8",
                "method": "xor",
                "covers": ["kind", "length", "body"],
                "about": "All of them combined.",
            },
        },
        "bare": SUMMED["frame"],
    },
    "messages": {
        "Sized": message(frame="sized", id=2, length=4, fields={"level": number("u8")}),
        "Wide": message(
            frame="bare", id=1, length=5, fields={"level": number("u16"), "more": number("u8")}
        ),
        "Narrow": message(frame="bare", id=3, length=3, fields={"level": number("u8")}),
    },
}


@pytest.mark.parametrize(
    ("data", "read"),
    [
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
    line = ReferenceDecoder(derive(Spec.model_validate(TWO_KINDS)), [Direction("sensor", "host")])
    assert named(line.decode(bytes.fromhex(data))) == [
        (name, bytes.fromhex(text)) for name, text in read
    ]
