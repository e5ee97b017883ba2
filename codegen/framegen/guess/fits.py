"""What fits the frames of a recording: lengths, checksums and what these cover, ids."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from framegen.guess.framing import (
    KINDS,
    MOST_BEFORE,
    MOST_UNCOUNTED,
    LengthFit,
    orders,
    read_number,
)
from framegen.guess.running import METHODS, checksum

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from framegen.guess.framing import Order

# What is not covered, or is covered alone, is looked for among so many bytes in front.
_MOST_IN_FRONT = 8
_MOST_IN_PIECES = 5
# So many bits have to be right before a checksum is believed: there are some ten thousand readings.
_ENOUGH_BITS = 40
# A checksum has to be right in so many of the frames: others may have been spoilt on the line.
_MOST_FRAMES = 0.9


@dataclass(frozen=True)
class ChecksumFit:
    """A method and the bytes that it covers: those of some offsets, and all behind `front`.

    `behind` is how many bytes follow the checksum.
    """

    method: str
    width: int
    order: Order
    behind: int
    offsets: tuple[int, ...]
    front: int

    @property
    def size(self) -> int:
        """Its size in bytes."""
        return self.width // 8

    @property
    def is_one_piece(self) -> bool:
        """Whether it covers all from some offset on."""
        first = self.front - len(self.offsets)
        return self.offsets == tuple(range(first, self.front))

    def holds(self, frame: bytes) -> bool:
        """Return whether a frame has this checksum."""
        end = len(frame) - self.behind
        at = end - self.size
        if at < self.front:
            return False
        covered = bytes(frame[offset] for offset in self.offsets) + frame[self.front : at]
        return checksum(self.method, self.width, covered) == read_number(frame[at:end], self.order)


def length_fits(frames: Sequence[bytes]) -> list[LengthFit]:
    """Return each number that says the size of every frame, if the sizes differ."""
    if len({len(frame) for frame in frames}) == 1:
        return []
    least = min(map(len, frames))
    fits = []
    for at in range(min(least, MOST_BEFORE + 4)):
        for kind in KINDS:
            if at + kind.size > least:
                continue
            uncounted = len(frames[0]) - kind.read(frames[0], at)
            fit = LengthFit(at, kind, uncounted)
            if 0 <= uncounted <= MOST_UNCOUNTED and all(
                fit.size_of(frame) == len(frame) for frame in frames
            ):
                fits.append(fit)
    return fits


def checksum_fits(frames: Sequence[bytes], ended: int) -> list[ChecksumFit]:
    """Return each reading of the last bytes as a checksum, with `ended` constant ones behind it.

    A reading that leaves out bytes in the middle is given only where none in one piece fits.
    """
    # The shortest tell most for the time that they take; each is another one.
    chosen = sorted(frames, key=len)[:60]
    fits = [*_fitting(chosen, ended, _MOST_IN_FRONT, _in_one_piece)]
    fits = fits or [*_fitting(chosen, ended, _MOST_IN_PIECES, _in_pieces)]
    return [fit for fit in fits if _is_believed(fit, frames)]


def likely_checksums(frames: Sequence[bytes], ended: int) -> list[ChecksumFit]:
    """Return those in one piece that are right for all of a few frames, which may be chance."""
    if len(frames) * 8 >= _ENOUGH_BITS:
        return []
    fits = _fitting(sorted(frames, key=len), ended, _MOST_IN_FRONT, _in_one_piece)
    return [fit for fit in fits if _varies(fit, frames)]


def _fitting(
    frames: Sequence[bytes],
    ended: int,
    most: int,
    covers: Callable[[int], Iterator[tuple[int, ...]]],
) -> Iterator[ChecksumFit]:
    least = len(frames[0])
    for method, width in METHODS:
        for behind in range(ended + 1):
            front = max(0, min(most, least - behind - width // 8))
            for offsets in covers(front):
                for order in orders(width):
                    fit = ChecksumFit(method, width, order, behind, offsets, front)
                    if _is_worth_it(fit, frames):
                        yield fit


def _in_one_piece(front: int) -> Iterator[tuple[int, ...]]:
    for first in range(front + 1):
        yield tuple(range(first, front))


def _in_pieces(front: int) -> Iterator[tuple[int, ...]]:
    for count in range(front, -1, -1):
        yield from combinations(range(front), count)


def _is_worth_it(fit: ChecksumFit, frames: Sequence[bytes]) -> bool:
    """Return whether it is right for most of some frames; decided by the first, mostly."""
    wrong = 0
    for frame in frames:
        wrong += not fit.holds(frame)
        if wrong > len(frames) // 10:
            return False
    return True


def _is_believed(fit: ChecksumFit, frames: Sequence[bytes]) -> bool:
    right = sum(map(fit.holds, frames))
    return (
        right >= _MOST_FRAMES * len(frames)
        and right * fit.width >= _ENOUGH_BITS
        and _varies(fit, frames)
    )


def _varies(fit: ChecksumFit, frames: Sequence[bytes]) -> bool:
    """Return whether checksums differ: the same in all frames may as well be a constant."""
    return len({frame[len(frame) - fit.behind - fit.size :][: fit.size] for frame in frames}) > 1
