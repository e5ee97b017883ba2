"""The number types that fields can have: a new type is a new row here.

The Python library has a class for each, in `number.py` of its runtime.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class NumberType:
    """A number on the wire: its name, size in bytes, range, and letter in Python's struct."""

    name: str
    size: int
    low: int
    high: int
    code: str


NUMBER_TYPES = {
    number_type.name: number_type
    for number_type in (
        NumberType("u8", 1, 0, 0xFF, "B"),
        NumberType("u16", 2, 0, 0xFFFF, "H"),
        NumberType("u32", 4, 0, 0xFFFF_FFFF, "I"),
        NumberType("i8", 1, -0x80, 0x7F, "b"),
        NumberType("i16", 2, -0x8000, 0x7FFF, "h"),
        NumberType("i32", 4, -0x8000_0000, 0x7FFF_FFFF, "i"),
    )
}
