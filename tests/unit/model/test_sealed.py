"""Checksums are worked out in turn: one that another covers comes first, wherever they stand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from framegen.language.spec import Frame
from framegen.model.envelope import derive_envelope
from pydantic import TypeAdapter

if TYPE_CHECKING:
    from collections.abc import Mapping

PARTS: Mapping[str, Any] = {
    "start": {"is": "constant", "bytes": "55"},
    "body": {"is": "body"},
}
INNER = {"is": "checksum", "type": "u8", "method": "xor", "covers": ["body"]}
OUTER = {"is": "checksum", "type": "u8", "method": "sum", "covers": ["start", "body", "inner"]}


@pytest.mark.parametrize(
    ("parts", "sealed"),
    [
        ({**PARTS, "inner": INNER, "outer": OUTER}, "55 01 03 02 5B"),
        ({**PARTS, "outer": OUTER, "inner": INNER}, "55 01 03 5B 02"),
        ({"outer": OUTER, **PARTS, "inner": INNER}, "5B 55 01 03 02"),
    ],
)
def test_the_outer_one_covers_what_the_inner_one_is(parts: dict[str, Any], sealed: str) -> None:
    frame = derive_envelope(TypeAdapter(Frame).validate_python(parts), "little")
    whole = bytes.fromhex(sealed)
    assert [each.name for each in frame.checksums] == ["inner", "outer"]
    blank = bytearray(whole)
    for checksum in frame.checksums:
        blank[checksum.at] = 0
    assert frame.sealed(bytes(blank), {}) == whole


def fletcher(*covers: str) -> dict[str, Any]:
    return {"is": "checksum", "type": "u16", "method": "fletcher-8", "covers": covers}


HIDDEN = {"is": "id", "type": "u16", "sent": False}


@pytest.mark.parametrize(
    ("parts", "sealed"),
    [
        # Between what it covers, and behind it, stands what it does not.
        (
            {"start": PARTS["start"], "gap": {"is": "reserved", "bytes": "07"}}
            | {"body": PARTS["body"], "check": {**INNER, "covers": ["start", "body"]}},
            "55 07 01 03 57",
        ),
        (
            {**PARTS, "check": fletcher("body"), "end": {"is": "constant", "bytes": "0A"}},
            "55 01 03 04 05 0A",
        ),
        # In the order in which they are named.
        ({**PARTS, "check": fletcher("body", "start")}, "55 01 03 59 5E"),
        ({**PARTS, "what": HIDDEN, "check": fletcher("body", "what")}, "55 01 03 07 11"),
    ],
)
def test_a_checksum_covers_what_is_named_and_no_more(parts: dict[str, Any], sealed: str) -> None:
    frame = derive_envelope(TypeAdapter(Frame).validate_python(parts), "little")
    whole, (check,) = bytes.fromhex(sealed), frame.checksums
    at = check.at + len(whole)
    blank = whole[:at] + bytes(check.size) + whole[at + check.size :]
    assert frame.sealed(blank, {"what": 0x0201}) == whole


def test_a_circle_of_checksums_ends_as_well() -> None:
    circle = {**PARTS, "inner": {**INNER, "covers": ["outer"]}, "outer": OUTER}
    frame = derive_envelope(TypeAdapter(Frame).validate_python(circle), "little")
    assert {each.name for each in frame.checksums} == {"inner", "outer"}
