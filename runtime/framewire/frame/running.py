"""Registers of a checksum that run along with a stream, so that no byte is summed again and again.

Any byte of noise may look like the start of a frame that claims to be long. To sum what each one
claims would cost the square of that length.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, TypeAlias

    from typing_extensions import Self

    # What a checksum covers: a stretch of the bytes held, or bytes that are not sent.
    Piece: TypeAlias = tuple[int, int] | bytes


class Running(ABC):
    """The checksum of any stretch of a stream, in which frames are looked for further and further.

    What lies behind everything looked at so far is summed at once, which is all that clean traffic
    costs. What has been summed before is answered from the registers behind each of its bytes: so
    no byte is summed more than twice. These are kept from the start of the last stretch on.
    """

    __slots__ = ("_checksum", "_first", "_registers", "_seen")

    _checksum: Any
    """The method; each has a class of its own."""

    def __init__(self, checksum: Any) -> None:
        self._checksum = checksum
        # How far the stream has been summed, and where the first register stands in it.
        self._seen = self._first = 0
        self._registers: list[Any] = []

    def copy(self) -> Self:
        """Return another one that knows as much."""
        other = type(self)(self._checksum)
        for name in Running.__slots__:
            value = getattr(self, name)
            setattr(other, name, [*value] if isinstance(value, list) else value)
        return other

    def of(self, data: bytes, base: int, *pieces: Piece) -> int:
        """Return the checksum of pieces, where `data` is what is held from byte `base` on."""
        start = min((piece[0] for piece in pieces if isinstance(piece, tuple)), default=0)
        end = max((piece[1] for piece in pieces if isinstance(piece, tuple)), default=0)
        before, self._seen = self._seen, max(self._seen, base + end)
        if base + start >= before:
            return self._at_once(data, pieces)
        back = self._reach(data, base + start, end - start, end) - start
        return self._joined(
            [
                (piece[0] + back, piece[1] + back) if isinstance(piece, tuple) else piece
                for piece in pieces
            ]
        )

    def _at_once(self, data: bytes, pieces: tuple[Piece, ...]) -> int:
        of: Callable[[bytes], int] = self._checksum.of
        return of(
            b"".join(
                data[piece[0] : piece[1]] if isinstance(piece, tuple) else piece for piece in pieces
            )
        )

    def _reach(self, data: bytes, start: int, size: int, end: int) -> int:
        """Have registers from byte `start` of the stream on; return the number of the first."""
        registers, at = self._registers, start - self._first
        if not 0 <= at < len(registers):
            self._registers = registers = [self._begin()]
            self._first, at = start, 0
        elif at > len(registers) // 2:
            # Not each time: what is left has to be moved.
            del registers[:at]
            self._first, at = start, 0
        missing = at + size + 1 - len(registers)
        if missing > 0:
            self._go_on(data[end - missing : end])
        return at

    @abstractmethod
    def _begin(self) -> object:
        """Return the first register."""

    @abstractmethod
    def _go_on(self, data: bytes) -> None:
        """Append a register for each byte."""

    @abstractmethod
    def _joined(self, pieces: list[Piece]) -> int:
        """Return the checksum of pieces, which are stretches of the registers or bytes."""
