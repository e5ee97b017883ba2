"""Checksums of two sums: of the bytes, and of what the first sum was after each of them."""

from __future__ import annotations

from itertools import accumulate

from .running import Running

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable

    from .running import Piece


class Fletcher:
    """Two sums modulo `modulus`, in a number of `width` bits whose lower half is the first one.

    The first begins at `start`. `of` is a function, which returns the checksum of some bytes.
    """

    __slots__ = ("half", "modulus", "of", "start")

    def __init__(self, width: int, modulus: int, *, start: int = 0) -> None:
        self.half = half = width // 2
        self.modulus = modulus
        self.start = start
        self.of: Callable[[bytes], int] = lambda data: (
            (start * len(data) + sum(accumulate(data))) % modulus << half
            | (start + sum(data)) % modulus
        )

    def running(self) -> RunningFletcher:
        """Return what works it out along a stream."""
        return RunningFletcher(self)


class RunningFletcher(Running):
    """The two sums of any stretch of a stream."""

    __slots__ = ()

    _checksum: Fletcher

    def _begin(self) -> tuple[int, int]:
        return 0, 0

    def _go_on(self, data: bytes) -> None:
        registers = self._registers
        first, second = registers.pop()
        firsts = [*accumulate(data, initial=first)]
        # The last register is there already, with what the first sum was behind it.
        registers += zip(firsts, accumulate(firsts[1:], initial=second), strict=True)

    def _joined(self, pieces: list[Piece]) -> int:
        registers, first, second = self._registers, self._checksum.start, 0
        for piece in pieces:
            if isinstance(piece, bytes):
                for byte in piece:
                    first += byte
                    second += first
                continue
            (first_before, second_before) = registers[piece[0]]
            (first_behind, second_behind) = registers[piece[1]]
            size = piece[1] - piece[0]
            second += size * (first - first_before) + second_behind - second_before
            first += first_behind - first_before
        modulus = self._checksum.modulus
        return second % modulus << self._checksum.half | first % modulus
