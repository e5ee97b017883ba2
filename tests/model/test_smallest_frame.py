"""Of the frames that some bytes may begin, the smallest counts, so that cuts make no difference."""

from __future__ import annotations

from typing import Any

import pytest
from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model.model import derive
from framegen.model.stream import ReferenceDecoder


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


@pytest.mark.parametrize("size", [3, 4])
def test_it_is_the_smallest_however_much_is_there(size: int) -> None:
    line = ReferenceDecoder(derive(Spec.model_validate(SUMMED)), [Direction("sensor", "host")])
    # All four bytes are a frame of the larger one.
    data = bytes.fromhex("01 05 04 00")
    first = line.decode_so_far(data[:size])[0]
    assert first.message is not None
    assert (first.message.name, first.data) == ("Narrow", data[:3])


def test_what_is_no_smaller_frame_may_be_a_larger_one() -> None:
    line = ReferenceDecoder(derive(Spec.model_validate(SUMMED)), [Direction("sensor", "host")])
    (event,) = line.decode(bytes.fromhex("01 05 06 02"))
    assert event.message is not None
    assert event.message.name == "Wide"
