"""Checksums are worked out in turn: one that another covers comes first, wherever they stand."""

from collections.abc import Mapping
from typing import Any

from framegen.language.spec import Frame
from framegen.model.envelope import Envelope, derive_envelope
from pydantic import TypeAdapter

from tests.in_turn import in_turn

PARTS: Mapping[str, Any] = {"start": {"is": "constant", "bytes": "55"}, "body": {"is": "body"}}
INNER = {"is": "checksum", "type": "u8", "method": "xor", "covers": ["body"]}
BOTH = {**INNER, "covers": ["start", "body"]}
GAP, GAPPED = {"is": "reserved", "bytes": "07"}, "55 07 01 03 57"
END = {"is": "constant", "bytes": "0A"}
OUTER = {"is": "checksum", "type": "u8", "method": "sum", "covers": ["start", "body", "inner"]}


HIDDEN = {"is": "id", "type": "u16", "sent": False}


def fletcher(*covers: str) -> dict[str, Any]:
    return {"is": "checksum", "type": "u16", "method": "fletcher-8", "covers": covers}


def envelope_of(parts: dict[str, Any]) -> Envelope:
    return derive_envelope(TypeAdapter(Frame).validate_python(parts), "little")


@in_turn(
    "parts, sealed",
    lambda: [
        # The outer one covers what the inner one is.
        ({**PARTS, "inner": INNER, "outer": OUTER}, "55 01 03 02 5B"),
        ({**PARTS, "outer": OUTER, "inner": INNER}, "55 01 03 5B 02"),
        ({"outer": OUTER, **PARTS, "inner": INNER}, "5B 55 01 03 02"),
        # Between what it covers, and behind it, stands what it does not.
        ({"start": PARTS["start"], "gap": GAP, "body": PARTS["body"], "check": BOTH}, GAPPED),
        ({**PARTS, "check": fletcher("body"), "end": END}, "55 01 03 04 05 0A"),
        # In the order in which they are named.
        ({**PARTS, "check": fletcher("body", "start")}, "55 01 03 59 5E"),
        ({**PARTS, "what": HIDDEN, "check": fletcher("body", "what")}, "55 01 03 07 11"),
    ],
)
def test_a_checksum_covers_what_is_named_and_no_more(parts: dict[str, Any], sealed: str) -> None:
    frame, whole = envelope_of(parts), bytes.fromhex(sealed)
    names = [each.name for each in frame.checksums]
    assert names == (["inner", "outer"] if "inner" in parts else ["check"])
    blank = bytearray(whole)
    for checksum in frame.checksums:
        at = checksum.at % len(whole)
        blank[at : at + checksum.size] = bytes(checksum.size)
    assert frame.sealed(bytes(blank), {"what": 0x0201}) == whole


def test_a_circle_of_checksums_ends_as_well() -> None:
    circle = {**PARTS, "inner": {**INNER, "covers": ["outer"]}, "outer": OUTER}
    assert {each.name for each in envelope_of(circle).checksums} == {"inner", "outer"}
