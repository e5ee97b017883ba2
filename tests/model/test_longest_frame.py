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
