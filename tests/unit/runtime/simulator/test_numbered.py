"""Devices listed by number, as people write them."""

from __future__ import annotations

from argparse import ArgumentTypeError

import pytest
from framewire.simulator.numbered import Numbered

from tests.in_turn import in_turn

LAMPS = Numbered("lamp", 253)


@in_turn(
    "text, numbers",
    lambda: [
        *(("1", [1]), ("1-3", [1, 2, 3]), ("1-2,9", [1, 2, 9]), ("9, 0-1", [9, 0, 1])),
        *(("253", [253]), ("2,2", [2, 2])),
    ],
)
def test_numbers_are_listed_in_their_order(text: str, numbers: list[int]) -> None:
    assert LAMPS.read(text) == numbers


@in_turn("text", lambda: ["", "3-1", "254", "x", "-1", "1-", "1_0", "+1", "\u0663"])
def test_what_names_none_is_refused(text: str) -> None:
    with pytest.raises(ArgumentTypeError, match=r"names no lamps: lamps are numbered 0 to 253,"):
        LAMPS.read(text)
