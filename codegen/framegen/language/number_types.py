"""The number types that fields can have: a new type is a new row here.

Python libraries have a class for each, in the room `frame` of their runtime.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class NumberType:
    """A number on the wire: its name, size in bytes, range, and letter in Python's struct.

    Where `struct` has no letter for it, `code` is empty. `bits` is its size in bits, for packed
    numbers no multiple of eight; the range of a floating-point number is that of finite ones.
    """

    name: str
    size: int
    low: int
    high: int
    code: str
    bits: int
    is_float: bool = False

    @property
    def is_packed(self) -> bool:
        """Whether it fills no whole bytes by itself."""
        return self.bits % 8 != 0


def _whole(name: str, code: str = "") -> NumberType:
    """Return the type of whole numbers of this name, `u16` or `i16`."""
    bits = int(name[1:])
    low = 0 if name.startswith("u") else -(1 << bits - 1)
    return NumberType(name, -(-bits // 8), low, low + (1 << bits) - 1, code, bits)


def _floating(name: str, code: str, highest: float) -> NumberType:
    """Return the type of floating-point numbers of IEEE 754 whose highest finite one is given."""
    bits = int(name[1:])
    return NumberType(name, bits // 8, -int(highest), int(highest), code, bits, is_float=True)


NUMBER_TYPES = {
    number_type.name: number_type
    for number_type in (
        _whole("u8", "B"),
        _whole("u16", "H"),
        _whole("u24"),
        _whole("u32", "I"),
        _whole("u64", "Q"),
        _whole("i8", "b"),
        _whole("i16", "h"),
        _whole("i24"),
        _whole("i32", "i"),
        _whole("i64", "q"),
        _floating("f32", "f", (2 - 2**-23) * 2.0**127),
        _floating("f64", "d", (2 - 2**-52) * 2.0**1023),
    )
}

# Numbers that stand bit by bit behind each other, in lists of a fixed size that fill whole bytes.
PACKED_TYPES = {f"u{bits}": _whole(f"u{bits}") for bits in range(1, 64) if bits % 8}

ALL_TYPES = NUMBER_TYPES | PACKED_TYPES
