"""The Python spelling of ranges, byte orders and directions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.values import Direction


def range_expression(numbers: range) -> str:
    """Return a range as Python code, in its shortest form."""
    if numbers.step != 1:
        return f"range({numbers.start}, {numbers.stop}, {numbers.step})"
    return f"range({numbers.start}, {numbers.stop})" if numbers.start else f"range({numbers.stop})"


def struct_order(byte_order: str) -> str:
    """Return the byte order as `struct` writes it."""
    return "<" if byte_order == "little" else ">"


def direction_member(direction: Direction) -> str:
    """Return the name of a direction in the enumeration: `HOST_TO_CONTROLLER`."""
    return direction.key.upper()
