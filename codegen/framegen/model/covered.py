"""What a checksum is worked out from: pieces of a frame, and what both ends know besides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.checksums import CHECKSUMS

if TYPE_CHECKING:
    from framegen.model.slots import Number


@dataclass(frozen=True)
class Covered:
    """Pieces of a frame, each a slice of it, and bytes that are not in it.

    The end of a slice is None or below zero where it counts from the end of the frame. Slices next
    to each other are one.
    """

    pieces: tuple[tuple[int, int | None] | bytes, ...] = ()

    def then(self, piece: tuple[int, int | None] | bytes) -> Covered:
        """Return these with one more piece behind them."""
        last = self.pieces[-1] if self.pieces else None
        if isinstance(last, bytes) and isinstance(piece, bytes):
            return Covered((*self.pieces[:-1], last + piece))
        if isinstance(last, tuple) and isinstance(piece, tuple) and last[1] == piece[0]:
            return Covered((*self.pieces[:-1], (last[0], piece[1])))
        return Covered((*self.pieces, piece))

    def of(self, frame: bytes) -> bytes:
        """Return these bytes of a whole frame."""
        return b"".join(
            piece if isinstance(piece, bytes) else frame[piece[0] : piece[1]]
            for piece in self.pieces
        )

    def checksum(self, checksum: Number, frame: bytes) -> bytes:
        """Return the checksum that a whole frame should have, as bytes."""
        value = CHECKSUMS[checksum.method].of(self.of(frame), 8 * checksum.size)
        return checksum.write(value)
