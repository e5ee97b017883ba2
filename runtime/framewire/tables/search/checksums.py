"""Checksums of many frames at once: running sums along the bytes, and tables for CRCs."""

from __future__ import annotations

from functools import cache, cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..places import read_numbers

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...protocol.envelope import Envelope
    from ...protocol.slots import Number
    from ..events import Bytes, Numbers

_BYTES = 256


def is_summed(envelope: Envelope, part: Number) -> bool:
    """Tell whether this method can be worked out here, for bytes that stand behind each other."""
    terms, usual = part.terms, {"word": 1, "carried": False, "left_out": 0, "mixed": False}
    plain = all(terms.get(name, value) == value for name, value in usual.items())
    return plain and terms.get("mask", 0xFF) == 0xFF and _covered(envelope, part) is not None


def _covered(envelope: Envelope, part: Number) -> tuple[int, int] | None:
    """Return from and to which byte a checksum covers, the end counted from that of the frame.

    None if it covers several pieces.
    """
    tail = sum(slot.size for slot in envelope.slots if slot.at < 0)
    least = envelope.least
    begin: int | None = None
    after = 0
    for name in part.of:
        slot = next((each for each in envelope.slots if each.name == name), None)
        if slot is None:
            return None
        # As places in the smallest frame, whose body is empty.
        at = slot.at if slot.at >= 0 else least + slot.at
        if begin is None:
            begin = at
        elif at != after:
            return None
        after = at + slot.size
    if begin is None:
        return None
    # What ends in front of the body ends there in every frame.
    reaches_body = any(slot.role == "body" and slot.name in part.of for slot in envelope.slots)
    return (begin, after - least) if reaches_body and after - least >= -tail else None


class Checksums:
    """The checksums of frames in a stretch of bytes."""

    def __init__(self, data: Bytes) -> None:
        self.data = data

    def are_right(
        self, envelope: Envelope, part: Number, places: Numbers, sizes: NDArray[np.int32]
    ) -> NDArray[np.bool_]:
        """Tell which frames have the checksum that they should have."""
        found = read_numbers(self.data, places + sizes + part.at, part)
        right: NDArray[np.bool_] = found == self._right(envelope, part, places, sizes)
        return right

    def _right(
        self, envelope: Envelope, part: Number, places: Numbers, sizes: NDArray[np.int32]
    ) -> Numbers:
        """Return what a checksum should be, in frames at some places."""
        begin, end = _covered(envelope, part) or (0, 0)
        begins, ends = places + begin, places + sizes + end
        terms, bits = part.terms, 8 * part.size
        found: Numbers
        match terms["kind"]:
            case "sum":
                total = self._sums[ends] - self._sums[begins]
                found = (total * int(terms["factor"]) + int(terms["offset"])) % (1 << bits)
            case "xor":
                mixed = (self._xors[ends] ^ self._xors[begins]).astype(np.int64)
                found = mixed ^ int(terms["xor_out"])
            case "fletcher":
                found = self._fletcher(begins, ends, terms["start"], terms["modulus"], bits)
            case _:
                found = self._crc(begins, ends, part)
        return found

    @cached_property
    def _sums(self) -> Numbers:
        """The sum of all bytes in front of each place."""
        return np.concatenate(([0], np.cumsum(self.data, dtype=np.int64)))

    @cached_property
    def _sums_of_sums(self) -> Numbers:
        return np.cumsum(self._sums)

    @cached_property
    def _xors(self) -> Bytes:
        zero = np.zeros(1, np.uint8)
        return np.concatenate((zero, np.bitwise_xor.accumulate(self.data)))

    def _fletcher(
        self, begins: Numbers, ends: Numbers, start: int, modulus: int, bits: int
    ) -> Numbers:
        count, before = ends - begins, self._sums[begins]
        first = start + self._sums[ends] - before
        # Each byte is added to the second sum as often as bytes stand behind it, and once more.
        second = self._sums_of_sums[ends] - self._sums_of_sums[begins] + count * (start - before)
        return second % modulus << bits // 2 | first % modulus

    def _crc(self, begins: Numbers, ends: Numbers, part: Number) -> Numbers:
        terms, bits = part.terms, 8 * part.size
        reflected = bool(terms["reflected"])
        table = _crc_table(int(terms["poly"]), bits, reflected=reflected)
        init = int(terms["init"])
        # The longest first, so that those which go on are always the first ones.
        order = np.argsort(begins - ends, kind="stable")
        at, count = begins[order], (ends - begins)[order]
        register = np.full(len(at), _turned(init, bits) if reflected else init, np.int64)
        for number in range(int(count[0]) if len(count) else 0):
            going = int(np.searchsorted(-count, -number, side="left"))
            byte = self.data[at[:going] + number].astype(np.int64)
            old = register[:going]
            if reflected:
                register[:going] = old >> 8 ^ table[(old ^ byte) & 0xFF]
            else:
                register[:going] = (old << 8 & (1 << bits) - 1) ^ table[
                    (old >> bits - 8 ^ byte) & 0xFF
                ]
        found = np.empty_like(register)
        found[order] = register ^ int(terms["xor_out"])
        return found


@cache
def _crc_table(poly: int, bits: int, *, reflected: bool) -> Numbers:
    """Return what each byte adds to a register."""
    table = np.zeros(_BYTES, np.int64)
    top = 1 << bits - 1
    for byte in range(_BYTES):
        register = (_turned(byte, 8) if reflected else byte) << bits - 8
        for _ in range(8):
            register = (register << 1) % (top << 1) ^ (poly if register & top else 0)
        table[byte] = _turned(register, bits) if reflected else register
    return table


def _turned(value: int, bits: int) -> int:
    return int(f"{value:0{bits}b}"[::-1], 2)
