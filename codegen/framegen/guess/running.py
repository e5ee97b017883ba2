"""The checksums of all beginnings of some bytes, for searches that try every end."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, lru_cache
from itertools import accumulate
from operator import xor
from typing import TYPE_CHECKING

from framegen.model.checksums import CHECKSUMS, Crc, Fletcher, Sum, Xor

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

METHODS = tuple((name, width) for name, row in CHECKSUMS.items() for width in row.widths)
"""Every method in each of its widths, in bits."""


def running(method: str, width: int, data: bytes) -> Sequence[int]:
    """Return the checksums of the first byte, of the first two bytes, and so on."""
    row = CHECKSUMS[method]
    match row:
        case Sum():
            return _sum(row, width - row.left_out, data)
        case Xor():
            values = accumulate(_placed(data, row.word), xor, initial=row.xor_out)
            return [value & row.mask for value in values][1:]
        case Fletcher():
            return _fletcher(row, width, data)
        case Crc():
            return _crc(row, width, data)
    raise AssertionError(f"{method} is of no known kind")


# It is compared in one order, and then in the other.
@lru_cache(maxsize=256)
def checksum(method: str, width: int, data: bytes) -> int:
    """Return the checksum of some bytes, as CHECKSUMS has it, but faster."""
    return running(method, width, data)[-1] if data else CHECKSUMS[method].of(data, width)


@cache
def inverse_table(method: str) -> dict[int, int]:
    """Return which last byte makes which difference to a CRC, against a last byte of zero."""
    row = CHECKSUMS[method]
    if not isinstance(row, Crc):
        raise TypeError(f"{method} is no CRC")
    table = _table(row.poly, row.width, reflected=row.reflected)
    if row.mixed:
        table = [_turned(value, row.width) for value in table]
    return {difference: byte for byte, difference in enumerate(table)}


def _sum(row: Sum, bits: int, data: bytes) -> list[int]:
    mask = (1 << bits) - 1
    totals = [*accumulate(_placed(data, row.word))]
    if row.carried:
        totals = [(total - 1) % mask + 1 if total else 0 for total in totals]
    return [(row.factor * total + row.offset) & mask for total in totals]


def _placed(data: bytes, word: int) -> Iterable[int]:
    """Return the bytes, each as it counts in the number of `word` bytes that it is in."""
    return data if word == 1 else (byte << at % word * 8 for at, byte in enumerate(data))


def _fletcher(row: Fletcher, width: int, data: bytes) -> list[int]:
    firsts = [*accumulate(data, initial=row.start)][1:]
    half, modulus = width // 2, row.modulus
    return [
        second % modulus << half | first % modulus
        for first, second in zip(firsts, accumulate(firsts), strict=True)
    ]


def _crc(row: Crc, width: int, data: bytes) -> list[int]:
    table, xor_out = _table(row.poly, width, reflected=row.reflected), row.xor_out
    values = []
    if row.reflected:
        register = _turned(row.init, width)
        for byte in data:
            register = table[(register ^ byte) & 0xFF] ^ register >> 8
            values.append((_turned(register, width) if row.mixed else register) ^ xor_out)
        return values
    register, shift, kept = row.init, width - 8, (1 << width - 8) - 1
    for byte in data:
        register = table[register >> shift ^ byte] ^ (register & kept) << 8
        values.append(register ^ xor_out)
    return values


@cache
def _table(poly: int, width: int, *, reflected: bool) -> list[int]:
    """Return what each byte makes of a register that is zero, as the catalogue has it."""
    any_of_them = next(row for row in CHECKSUMS.values() if isinstance(row, Crc))
    plain = replace(any_of_them, poly=poly, init=0, reflected=reflected, xor_out=0, mixed=False)
    return [plain.of(bytes([byte]), width) for byte in range(256)]


def _turned(value: int, width: int) -> int:
    return int(f"{value:0{width}b}"[::-1], 2)
