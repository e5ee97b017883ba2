"""Checksums that cover a byte which is not sent, and which both ends know by the message."""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.guess.framing import orders, read_number
from framegen.guess.running import checksum, inverse_table
from framegen.model.checksums import CHECKSUMS, Crc

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from framegen.guess.framing import Order

_MOST_IN_FRONT = 4
# Of a frame eight bits fewer are right by design: each has one byte that makes them so.
_ENOUGH_BITS = 64


@dataclass(frozen=True)
class HiddenFit:
    """A CRC over all from an offset on, and a byte that follows from the byte at `by`.

    Where it is the same for all frames, `by` is None.
    """

    method: str
    width: int
    order: Order
    first: int
    by: int | None
    bytes_: Mapping[int, int]

    @property
    def size(self) -> int:
        """Its size in bytes."""
        return self.width // 8

    def hidden(self, frame: bytes) -> int | None:
        """Return the byte that is not sent, None for a frame of another message."""
        if self.by is None:
            return next(iter(self.bytes_.values()))
        return self.bytes_.get(frame[self.by]) if self.by < len(frame) - self.size else None

    def holds(self, frame: bytes) -> bool:
        """Return whether a frame has this checksum."""
        hidden = self.hidden(frame)
        if hidden is None:
            return False
        value = checksum(self.method, self.width, frame[self.first : -self.size] + bytes([hidden]))
        return value == read_number(frame[-self.size :], self.order)


def hidden_fits(frames: Sequence[bytes], taken: set[int]) -> list[HiddenFit]:
    """Return each reading of the last bytes as a CRC over one byte more than there is.

    No byte at an offset that is `taken` says which one.
    """
    fits = []
    for name, row in CHECKSUMS.items():
        if not isinstance(row, Crc) or row.width < 16:
            continue
        for order in orders(row.width):
            for first in range(_MOST_IN_FRONT):
                found = _found(row, order, first, frames)
                fits += [
                    HiddenFit(name, row.width, order, first, by, by_byte)
                    for by, by_byte in _followed(frames, found, taken)
                ]
    # What says it in the fewest ways.
    fewest = min((len(fit.bytes_) for fit in fits), default=0)
    return [fit for fit in fits if len(fit.bytes_) == fewest]


def _found(row: Crc, order: Order, first: int, frames: Sequence[bytes]) -> list[int | None]:
    """Return the byte that each frame needs, None for a few that have none; or nothing."""
    size, inverse = row.width // 8, inverse_table(row.name)
    found: list[int | None] = []
    if len(frames) * (row.width - 8) < _ENOUGH_BITS or len(min(frames, key=len)) <= first + size:
        return found
    for frame in frames:
        value = read_number(frame[-size:], order)
        byte = inverse.get(value ^ checksum(row.name, row.width, frame[first:-size] + b"\0"))
        found.append(byte)
        if found.count(None) > len(frames) // 10:
            return []
    return found


def _followed(
    frames: Sequence[bytes], found: Sequence[int | None], taken: set[int]
) -> list[tuple[int | None, dict[int, int]]]:
    """Return the offsets whose byte says which one it is; None where it is always the same."""
    known = Counter(byte for byte in found if byte is not None)
    if not known:
        return []
    [(usual, count)] = known.most_common(1)
    if count >= 0.9 * len(frames):
        return [(None, {0: usual})]
    fits: list[tuple[int | None, dict[int, int]]] = []
    for by in range(min(map(len, frames)) - 2):
        counted: dict[int, Counter[int]] = defaultdict(Counter)
        for frame, byte in zip(frames, found, strict=True):
            if byte is not None:
                counted[frame[by]][byte] += 1
        by_byte = {key: those.most_common(1)[0] for key, those in counted.items()}
        agreed = sum(count for _, count in by_byte.values())
        if by not in taken and agreed >= 0.9 * len(frames) and len(by_byte) <= len(frames) // 4:
            fits.append((by, {key: byte for key, (byte, _) in by_byte.items()}))
    return fits
