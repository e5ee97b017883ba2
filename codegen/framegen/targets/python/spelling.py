"""What has one spelling in Python wherever it is named: ranges, byte orders, directions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.values import Direction


def range_expression(numbers: range) -> str:
    """A range as Python writes it, with nothing that goes without saying."""
    if numbers.step != 1:
        return f"range({numbers.start}, {numbers.stop}, {numbers.step})"
    return f"range({numbers.start}, {numbers.stop})" if numbers.start else f"range({numbers.stop})"


def struct_order(byte_order: str) -> str:
    """The byte order as `struct` writes it."""
    return "<" if byte_order == "little" else ">"


def direction_member(direction: Direction) -> str:
    """The name of a direction in the enumeration: `HOST_TO_CONTROLLER`."""
    return direction.key.upper()
