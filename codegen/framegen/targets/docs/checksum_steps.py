"""How a checksum comes about, byte by byte, in a line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.language.values import to_hex
from framegen.model.checksums import CHECKSUMS, Sum, Xor

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.model.checksums import Checksum

# Of more bytes, only the checksum is shown.
_MOST = 12


def worked_out(name: str, size: int, data: bytes) -> str:
    """Work out a checksum of so many bytes: `01 + 03 + 1C = 20, inverted DF`."""
    method = CHECKSUMS[name]
    value = f"{method.of(data, 8 * size):0{2 * size}X}"
    if len(data) > _MOST:
        return f"the {name} of {len(data)} bytes is {value}"
    match method:
        case Sum() if method.word == 1 and not method.carried and not method.left_out:
            return _added_up(method, size, data, value)
        case Xor() if method.word == 1 and not method.xor_out and method.mask == 0xFF:
            return f"{to_hex(data).replace(' ', ' xor ')} = {value}"
        case _:
            # After the first byte, after two of them, and so on.
            each = (method.of(data[: end + 1], 8 * size) for end in range(len(data)))
            values = ", ".join(f"{number:0{2 * size}X}" for number in each)
            return f"the {name} of {to_hex(data)} is, from byte to byte, {values}"


def as_formula(name: str, size: int, parts: Sequence[str]) -> str:
    """Write a checksum of named parts as most languages do: `~(id + length) & 0xFF`.

    Nothing is returned for a method that takes more than one operation a byte.
    """
    method, mask = CHECKSUMS[name], f"0x{(1 << 8 * size) - 1:X}"
    match method:
        case Sum(factor=1, offset=0, word=1, carried=False, left_out=0):
            return f"({' + '.join(parts)}) & {mask}"
        case Sum(factor=-1, offset=-1, word=1, carried=False, left_out=0):
            return f"~({' + '.join(parts)}) & {mask}"
        case Sum(factor=-1, offset=0, word=1, carried=False, left_out=0):
            return f"-({' + '.join(parts)}) & {mask}"
        case Xor(xor_out=0, mask=0xFF, word=1):
            return " ^ ".join(parts)
        case _:
            return ""


def _added_up(method: Checksum, size: int, data: bytes, value: str) -> str:
    total = f"{sum(data):0{2 * size}X}"
    text = f"{to_hex(data).replace(' ', ' + ')} = {total}"
    if total != total[-2 * size :]:
        text += f", of which {total[-2 * size :]}"
    how = method.name.removesuffix("sum").strip()
    return f"{text}, {how} {value}" if how else text
