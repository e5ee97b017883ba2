"""Checksums that add bytes up, or take the exclusive or of them."""

from __future__ import annotations

from functools import reduce
from itertools import accumulate
from operator import xor

from .running import Running

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable

    from .running import Piece

# From so many bytes on, halves of one large number are faster than bytes one by one.
_LARGE = 128


class Sum:
    """The bytes added up, `width` bits of it, with each bit inverted or negated as a whole.

    `of` is a function, which returns the checksum of some bytes.
    """

    __slots__ = ("finish", "of")

    def __init__(self, width: int, *, inverted: bool = False, negated: bool = False) -> None:
        mask = (1 << width) - 1
        self.of: Callable[[bytes], int]
        self.finish: Callable[[int], int]
        if inverted:
            self.of = lambda data: ~sum(data) & mask
            self.finish = lambda total: ~total & mask
        elif negated:
            self.of = lambda data: -sum(data) & mask
            self.finish = lambda total: -total & mask
        else:
            self.of = lambda data: sum(data) & mask
            self.finish = lambda total: total & mask

    def running(self) -> RunningSum:
        """Return what works it out along a stream."""
        return RunningSum(self)


class Xor:
    """The exclusive or of all bytes, and of `xor_out`.

    `of` is a function, which returns the checksum of some bytes.
    """

    __slots__ = ("of", "xor_out")

    def __init__(self, xor_out: int = 0) -> None:
        self.xor_out = xor_out

        def of(data: bytes) -> int:
            if len(data) >= _LARGE:
                return _folded(data) ^ xor_out
            value = xor_out
            for byte in data:
                value ^= byte
            return value

        self.of: Callable[[bytes], int] = of

    def running(self) -> RunningXor:
        """Return what works it out along a stream."""
        return RunningXor(self)


class RunningSum(Running):
    """The sum of any stretch of a stream."""

    __slots__ = ()

    _checksum: Sum

    def _begin(self) -> int:
        return 0

    def _go_on(self, data: bytes) -> None:
        registers = self._registers
        registers += accumulate(data, initial=registers.pop())

    def _joined(self, pieces: list[Piece]) -> int:
        registers, total = self._registers, 0
        for piece in pieces:
            if isinstance(piece, bytes):
                total += sum(piece)
            else:
                total += registers[piece[1]] - registers[piece[0]]
        return self._checksum.finish(total)


class RunningXor(Running):
    """The exclusive or of any stretch of a stream."""

    __slots__ = ()

    _checksum: Xor

    def _begin(self) -> int:
        return 0

    def _go_on(self, data: bytes) -> None:
        registers = self._registers
        registers += accumulate(data, xor, initial=registers.pop())

    def _joined(self, pieces: list[Piece]) -> int:
        registers, value = self._registers, self._checksum.xor_out
        for piece in pieces:
            if isinstance(piece, bytes):
                value = reduce(xor, piece, value)
            else:
                value ^= registers[piece[1]] ^ registers[piece[0]]
        return value


def _folded(data: bytes) -> int:
    """Return the exclusive or of many bytes, by halves of one large number."""
    number, bits = int.from_bytes(data, "little"), 8
    while bits < 8 * len(data):
        bits *= 2
    while bits > 8:
        bits //= 2
        number = number >> bits ^ number & (1 << bits) - 1
    return number
