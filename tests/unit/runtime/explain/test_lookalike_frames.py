"""A frame of a look-alike is recognised, and cut into its parts."""

from __future__ import annotations

import pytest
from framewire.explain.lookalikes import recognise
from framewire.explain.slot_bytes import piece

from tests.factories import DEMO, compiled_file, compiled_of, data_of
from tests.in_turn import in_turn


@in_turn(
    "hex_, name, command, meaning",
    lambda: [
        ("C3 5A A5 04 02 20 01 D8", "orchard", 0x20, ""),
        ("C3 5A A5 04 01 20 DA", "orchard", 0x20, ""),
        ("C3 5A A5 04 02 20 02 D7", "orchard", 0x20, ""),
        ("C3 5A A5 21 00 00", "old_stations", 0x21, "asks for the firmware"),
        ("C3 5A A5 22 00 00", None, None, None),  # no code of theirs
        ("C3 5A A5 04 02 20 01 D9", None, None, None),  # a wrong checksum
        ("C3 5A A5 04 03 20 01 D7", None, None, None),  # a wrong length
        ("C3 5A A5 04 02 20 01 D8 00", None, None, None),  # a byte too many
        ("C3 5A A6 04 02 20 01 D8", None, None, None),  # a wrong preamble
        ("C3 5A", None, None, None),  # too short for any frame
        ("", None, None, None),
    ],
)
def test_a_lookalike_is_recognised(
    hex_: str, name: str | None, command: int | None, meaning: str | None
) -> None:
    found = recognise(compiled_file(DEMO).model.protocol, bytes.fromhex(hex_))
    row = (None, None, None) if found is None else (found.name, found.command, found.meaning)
    assert row == (name, command, meaning)


@pytest.mark.parametrize(("order", "size"), [("big", "00 01"), ("little", "01 00")])
def test_a_lookalike_is_cut_into_its_parts_in_the_byte_order(order: str, size: str) -> None:
    model = compiled_of({**data_of(DEMO), "byte_order": order}).derived
    assert model is not None
    data = bytes.fromhex(f"C3 5A A5 21 {size} FF")
    found = recognise(model.protocol, data)
    assert found is not None
    assert {placed.path: piece(placed, data) for placed in found.parts} == {
        "preamble": b"\xc3\x5a\xa5",
        "kind": b"\x21",
        "size": bytes.fromhex(size),
        "payload": b"\xff",
    }
