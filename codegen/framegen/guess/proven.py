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


class _Ends:
    """Where the checksums by one method stand behind what they cover.

    Each place is searched once: readings with other bytes left out begin to cover at the same.
    """

    def __init__(self, data: bytes, method: str, width: int) -> None:
        self.data = data
        self.width = width
        self.longest = _LONGEST.get(width, _LONGEST_OF_ALL)
        self._method = method
        self._found: dict[int, dict[Order, list[int]]] = {}

    def behind(self, first: int, order: Order) -> list[int]:
        """Return the ends of checksums in this order of all bytes from `first` on."""
        if first not in self._found:
            self._found[first] = self._search(first)
        return self._found[first][order]

    def _search(self, first: int) -> dict[Order, list[int]]:
        data, size = self.data, self.width // 8
        covered = data[first : max(0, min(first + self.longest, len(data)) - size)]
        values = running(self._method, self.width, covered)
        found: dict[Order, list[int]] = {}
        for order in orders(self.width):
            # Most are ruled out by the first byte alone.
            shift = 0 if order == "little" else self.width - 8
            near = zip(data[first + 1 : first + self.longest], values, strict=False)
            found[order] = [
                end + size
                for end, (byte, value) in enumerate(near, first + 1)
                if byte == value >> shift & 0xFF
                and read_number(data[end : end + size], order) == value
            ]
        return found


@dataclass(frozen=True)
class _Trial:
    """A method, the order of the bytes of its checksum, and how many bytes it leaves out."""

    checksums: _Ends
    order: Order
    left_out: int

    def ends(self, at: int) -> Iterator[int]:
        """Yield where a frame that begins here may end."""
        least, most = at + LEAST_FRAME, at + self.checksums.longest
        for end in self.checksums.behind(at + self.left_out, self.order):
            if least <= end <= most:
                yield end

    def has_row(self, at: int, frames: int = _ROW) -> bool:
        """Return whether so many frames follow each other from here on, or as many as there are."""
        if frames == 0 or (at == len(self._data) and frames < _ROW):
            return True
        return any(self.has_row(end, frames - 1) for end in self.ends(at))

    def framing(self) -> Framing:
        """Return the frames that cover most, as a length has them if one agrees with most."""
        chosen = self._chosen()
        length = _length(chosen.frames)
        if length is None:
            return chosen
        places, at = [], chosen.places[0][0]
        while at < len(self._data):
            end = at + (length.size_of(self._data, at) or 0)
            if end > at and end in self.ends(at):
                places.append((at, end))
                at = end
            else:
                at += 1
        told = Framing(self._data, tuple(places), is_proven=True)
        return told if told.covered >= _ENOUGH * chosen.covered else chosen

    def _chosen(self) -> Framing:
        """Return the frames that cover most, and are many: large ones may be chance."""
        data, size = self._data, len(self._data)
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
        return Framing(
            data, tuple(places), is_proven=True, chosen_bits=self.checksums.longest.bit_length()
        )

    @property
    def _data(self) -> bytes:
        return self.checksums.data


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
        checksums = _Ends(data, method, width)
        for order in orders(width):
            for left_out in range(4):
                yield _Trial(checksums, order, left_out)


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
