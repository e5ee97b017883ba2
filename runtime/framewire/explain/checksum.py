"""Checksums worked out from what a protocol says of their method, slow and plain."""

from __future__ import annotations

from ..protocol.places import from_front, lay_out
from .slot_bytes import piece, write

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Any

    from ..protocol.envelope import Envelope
    from ..protocol.slots import Number


def right(envelope: Envelope, part: Number, frame: bytes, unsent: Sequence[int] = ()) -> bytes:
    """Return a checksum as a whole frame should have it; `unsent` are the ids not in it."""
    hidden = zip(envelope.unsent, unsent, strict=False)
    pieces = {slot.name: write(slot, number) for slot, number in hidden}
    placed = lay_out(envelope.slots, len(frame))
    pieces |= {each.path: piece(each, frame) for each in placed}
    covered = b"".join(pieces.get(name, b"") for name in part.of)
    return write(part, checksum(part.terms, 8 * part.size, covered))


def sealed(envelope: Envelope, frame: bytes, unsent: Sequence[int] = ()) -> bytes:
    """Return a whole frame with the checksums that it should have."""
    mended = bytearray(frame)
    for part in envelope.checksums:
        at = from_front(part.at, len(frame))
        mended[at : at + part.size] = right(envelope, part, bytes(mended), unsent)
    return bytes(mended)


def checksum(terms: Mapping[str, Any], width: int, data: bytes) -> int:
    """Return the checksum of `data` in so many bits, by the terms of its method."""
    return _KINDS[terms["kind"]](terms, width, data)


def _sum(terms: Mapping[str, Any], width: int, data: bytes) -> int:
    bits = width - int(terms.get("left_out", 0))
    total = sum(_words(terms, data))
    if terms.get("carried") and total:
        total = (total - 1) % ((1 << bits) - 1) + 1
    return int((terms["factor"] * total + terms["offset"]) % (1 << bits))


def _xor(terms: Mapping[str, Any], width: int, data: bytes) -> int:
    value = int(terms["xor_out"])
    for word in _words(terms, data):
        value ^= word
    return value & int(terms.get("mask", (1 << width) - 1))


def _words(terms: Mapping[str, Any], data: bytes) -> list[int]:
    size = int(terms.get("word", 1))
    return [int.from_bytes(data[at : at + size], "little") for at in range(0, len(data), size)]


def _fletcher(terms: Mapping[str, Any], width: int, data: bytes) -> int:
    first, second = int(terms["start"]), 0
    for byte in data:
        first = (first + byte) % int(terms["modulus"])
        second = (second + first) % int(terms["modulus"])
    return second << width // 2 | first


def _crc(terms: Mapping[str, Any], width: int, data: bytes) -> int:
    register, top, is_reflected = int(terms["init"]), 1 << width - 1, terms["reflected"]
    for byte in data:
        register ^= (_turned(byte, 8) if is_reflected else byte) << width - 8
        for _ in range(8):
            carry = register & top
            register = (register << 1) % (top << 1) ^ (int(terms["poly"]) if carry else 0)
    is_turned = is_reflected and not terms.get("mixed")
    value = _turned(register, width) if is_turned else register
    return value ^ int(terms["xor_out"])


def _turned(value: int, width: int) -> int:
    return int(f"{value:0{width}b}"[::-1], 2)


_KINDS = {"sum": _sum, "xor": _xor, "fletcher": _fletcher, "crc": _crc}
