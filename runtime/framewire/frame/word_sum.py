"""Checksums that add numbers of several bytes up, carry what goes beyond, or leave bits out."""

from __future__ import annotations

from functools import reduce
from operator import xor

from .running import Running

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable

    from .running import Piece


class WordSum:
    """Numbers of `size` bytes added up, the low byte of each first: `bits` bits of it.

    With `carried`, what goes beyond these is added to the lowest. In the end each bit is inverted,
    or it is negated as a whole. `of` is a function, which returns the checksum of some bytes.
    """

    __slots__ = ("finish", "of", "size")

    def __init__(
        self,
        size: int,
        bits: int,
        *,
        inverted: bool = False,
        negated: bool = False,
        carried: bool = False,
    ) -> None:
        self.size = size
        mask, factor, offset = (1 << bits) - 1, -1 if inverted or negated else 1, -int(inverted)

        def finish(total: int) -> int:
            if carried and total:
                total = (total - 1) % mask + 1
            return (factor * total + offset) & mask

        def of(data: bytes) -> int:
            return finish(sum(sum(data[at::size]) << 8 * at for at in range(size)))

        self.finish: Callable[[int], int] = finish
        self.of: Callable[[bytes], int] = of if size > 1 else lambda data: finish(sum(data))

    def running(self) -> RunningWordSum:
        """Return what works it out along a stream."""
        return RunningWordSum(self)


class WordXor:
    """The exclusive or of numbers of `size` bytes and of `xor_out`: those bits that `mask` has.

    The low byte of each comes first. `of` is a function, which returns the checksum of some bytes.
    """

    __slots__ = ("mask", "of", "size", "xor_out")

    def __init__(self, size: int, mask: int, *, xor_out: int = 0) -> None:
        self.size, self.mask, self.xor_out = size, mask, xor_out

        def of(data: bytes) -> int:
            value = xor_out
            for at in range(size):
                value ^= reduce(xor, data[at::size], 0) << 8 * at
            return value & mask

        self.of: Callable[[bytes], int] = of

    def running(self) -> RunningWordXor:
        """Return what works it out along a stream."""
        return RunningWordXor(self)


class RunningWords(Running):
    """The checksum of any stretch of a stream, whose numbers begin wherever the stretch does.

    A register is what the last byte, the one before, and so on to the size of a number make with
    those that are a multiple of this size in front of each.
    """

    __slots__ = ()

    def _stretch(self, start: int, end: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Return the registers at both ends, bytes that are at one place of a number together."""
        registers = self._registers
        before = registers[start]
        size = len(before)
        turned = (end - start) % size
        return tuple(before[(at - turned) % size] for at in range(size)), registers[end]


class RunningWordSum(RunningWords):
    """The sum of any stretch of a stream."""

    __slots__ = ()

    _checksum: WordSum

    def _begin(self) -> tuple[int, ...]:
        return (0,) * self._checksum.size

    def _go_on(self, data: bytes) -> None:
        registers = self._registers
        for byte in data:
            *others, last = registers[-1]
            registers.append((last + byte, *others))

    def _joined(self, pieces: list[Piece]) -> int:
        size, total, length = self._checksum.size, 0, 0
        for piece in pieces:
            if isinstance(piece, bytes):
                for byte in piece:
                    total += byte << length % size * 8
                    length += 1
                continue
            before, behind = self._stretch(*piece)
            length += piece[1] - piece[0]
            for at in range(size):
                total += behind[at] - before[at] << (length - 1 - at) % size * 8
        return self._checksum.finish(total)


class RunningWordXor(RunningWords):
    """The exclusive or of any stretch of a stream."""

    __slots__ = ()

    _checksum: WordXor

    def _begin(self) -> tuple[int, ...]:
        return (0,) * self._checksum.size

    def _go_on(self, data: bytes) -> None:
        registers = self._registers
        for byte in data:
            *others, last = registers[-1]
            registers.append((last ^ byte, *others))

    def _joined(self, pieces: list[Piece]) -> int:
        size, value, length = self._checksum.size, self._checksum.xor_out, 0
        for piece in pieces:
            if isinstance(piece, bytes):
                for byte in piece:
                    value ^= byte << length % size * 8
                    length += 1
                continue
            before, behind = self._stretch(*piece)
            length += piece[1] - piece[0]
            for at in range(size):
                value ^= (behind[at] ^ before[at]) << (length - 1 - at) % size * 8
        return value & self._checksum.mask
