"""Where frames begin and end, as far as checksums tell: one behind the other, each proven."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.guess.framing import (
    KINDS,
    LEAST_FRAME,
    MOST_BEFORE,
    MOST_UNCOUNTED,
    Framing,
    LengthFit,
    orders,
    read_number,
)
from framegen.guess.running import METHODS, running

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.guess.framing import Order

# A checksum of a byte is right by chance too often for frames of any size.
_LONGEST = {8: 72}
_LONGEST_OF_ALL = 264
# So many frames in a row are no chance; looked for from each of the first bytes.
_ROW = 6
_BEGINNINGS = 32
# A length has to agree with so many frames: some may be two by chance.
_ENOUGH = 0.8
# Each frame more is worth so many bytes that are not in any.
_FOR_A_FRAME = 4
# So many bytes are enough to see which method it is, and where frames end.
_LOOKED_AT = 8192


@dataclass(frozen=True)
class _Trial:
    """A method, its width in bits, the order of its bytes, and how many bytes it leaves out."""

    data: bytes
    method: str
    width: int
    order: Order
    left_out: int

    def ends(self, at: int) -> Iterator[int]:
        """Yield where a frame that begins here may end."""
        size, first = self.width // 8, at + self.left_out
        covered = self.data[first : at + self._longest - size]
        little = self.order == "little"
        data = self.data
        for number, value in enumerate(running(self.method, self.width, covered)):
            end = first + number + 1
            # Most are ruled out by the first byte alone.
            if end + size > len(data):
                return
            digits = value & 0xFF if little else value >> self.width - 8
            if (
                data[end] == digits
                and end + size - at >= LEAST_FRAME
                and read_number(data[end : end + size], self.order) == value
            ):
                yield end + size

    def has_row(self, at: int, frames: int = _ROW) -> bool:
        """Return whether so many frames follow each other from here on, or as many as there are."""
        if frames == 0 or (at == len(self.data) and frames < _ROW):
            return True
        return any(self.has_row(end, frames - 1) for end in self.ends(at))

    def framing(self) -> Framing:
        """Return the frames that cover most, as a length has them if one agrees with most."""
        chosen = self._chosen()
        length = _length(chosen.frames)
        if length is None:
            return chosen
        places, at = [], chosen.places[0][0]
        while at < len(self.data):
            end = at + (length.size_of(self.data, at) or 0)
            if end > at and end in self.ends(at):
                places.append((at, end))
                at = end
            else:
                at += 1
        told = Framing(self.data, tuple(places), is_proven=True)
        return told if told.covered >= _ENOUGH * chosen.covered else chosen

    def _chosen(self) -> Framing:
        """Return the frames that cover most, and are many: large ones may be chance."""
        data, size = self.data, len(self.data)
        best = [0] * (size + 1)
        taken = [0] * (size + 1)
        for at in range(size - 1, -1, -1):
            best[at] = best[at + 1]
            for end in self.ends(at):
                reading = best[end] + end - at + _FOR_A_FRAME
                if reading > best[at]:
                    best[at], taken[at] = reading, end
        places, at = [], 0
        while at < size:
            if taken[at]:
                places.append((at, taken[at]))
            at = taken[at] or at + 1
        return Framing(data, tuple(places), is_proven=True, chosen_bits=self._longest.bit_length())

    @property
    def _longest(self) -> int:
        return _LONGEST.get(self.width, _LONGEST_OF_ALL)


def framed_by_checksum(data: bytes) -> list[Framing]:
    """Return the readings in which each frame has the right checksum, the best first."""
    data = data[:_LOOKED_AT]
    found: dict[tuple[tuple[int, int], ...], Framing] = {}
    for beginnings in (range(1), range(1, min(_BEGINNINGS, len(data)))):
        for trial in _trials(data):
            if any(trial.has_row(at) for at in beginnings):
                framing = trial.framing()
                if len(framing.places) >= _ROW and framing.is_joined:
                    found.setdefault(framing.places, framing)
        if found:
            break
    return sorted(found.values(), key=lambda each: (-each.covered, -len(each.places)))


def _trials(data: bytes) -> Iterator[_Trial]:
    for method, width in METHODS:
        for order in orders(width):
            for left_out in range(4):
                yield _Trial(data, method, width, order, left_out)


def _length(frames: Sequence[bytes]) -> LengthFit | None:
    """Return the number that is the size of most frames, if there is one."""
    votes: Counter[LengthFit] = Counter()
    for frame in frames:
        for at in range(min(MOST_BEFORE, len(frame))):
            for kind in KINDS:
                uncounted = len(frame) - kind.read(frame, at)
                if 0 <= uncounted <= MOST_UNCOUNTED and at + kind.size <= len(frame):
                    votes[LengthFit(at, kind, uncounted)] += 1
    enough = _ENOUGH * len(frames)
    likely = (length for length, count in votes.most_common(1) if count >= enough)
    return next(likely, None) if len({*map(len, frames)}) > 1 else None
