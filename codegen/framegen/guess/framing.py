"""Where frames begin and end, as far as constant bytes and lengths tell."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from math import log2
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

# Where a length is looked for: at so many offsets, with so many bytes that it does not count.
MOST_BEFORE = 10
MOST_UNCOUNTED = 24
# Votes of so many bytes are counted; the next headers looked at; the readings tried for a header.
_VOTING = 6144
_NEAR = 10
_TRIED = 8
_HEADERS = 10
LEAST_FRAME = 3


Order: TypeAlias = Literal["", "little", "big"]
"""The order of the bytes of a number; "" where it has one byte."""


def orders(width: int) -> tuple[Order, ...]:
    """Return the orders in which a number of so many bits may stand."""
    return ("little", "big") if width > 8 else ("",)


def read_number(data: bytes, order: Order) -> int:
    """Return the number that bytes are."""
    return int.from_bytes(data, order or "big")


@dataclass(frozen=True, order=True)
class NumberKind:
    """A number that may say how long a frame is: so many bytes, in an order."""

    size: int
    order: Order = ""

    def read(self, data: bytes, at: int) -> int:
        """Return its value."""
        return read_number(data[at : at + self.size], self.order)


KINDS = (NumberKind(1), NumberKind(2, "little"), NumberKind(2, "big"))


@dataclass(frozen=True, order=True)
class LengthFit:
    """A number at an offset which, with the bytes that it does not count, is the size."""

    at: int
    kind: NumberKind
    uncounted: int

    @property
    def end(self) -> int:
        """The offset behind it."""
        return self.at + self.kind.size

    def size_of(self, data: bytes, start: int = 0) -> int | None:
        """Return the size that a frame says it has; None where the number is not there."""
        if start + self.end > len(data):
            return None
        size = self.kind.read(data, start + self.at) + self.uncounted
        return size if size >= max(self.end, LEAST_FRAME) else None


@dataclass(frozen=True)
class Framing:
    """Frames of a recording, as one reading of it has them."""

    data: bytes
    places: tuple[tuple[int, int], ...]
    # Whether a checksum showed where they are; and if so, of how many ends one was chosen, in bits.
    is_proven: bool = False
    chosen_bits: int = 0

    @cached_property
    def is_joined(self) -> bool:
        """Whether most frames follow another."""
        pairs = zip(self.places, self.places[1:], strict=False)
        return sum(before[1] == behind[0] for before, behind in pairs) > 0.75 * len(self.places)

    @cached_property
    def frames(self) -> tuple[bytes, ...]:
        """The frames, in order."""
        return tuple(self.data[start:end] for start, end in self.places)

    @cached_property
    def distinct(self) -> tuple[bytes, ...]:
        """Those that differ."""
        return tuple(dict.fromkeys(self.frames))

    @cached_property
    def covered(self) -> int:
        """The number of bytes in frames."""
        return sum(end - start for start, end in self.places)

    @cached_property
    def least(self) -> int:
        """The size of the smallest frame."""
        return min(map(len, self.frames))

    @cached_property
    def begun(self) -> bytes:
        """The bytes that all frames begin with."""
        return _common(self.distinct)

    @cached_property
    def ended(self) -> bytes:
        """The bytes that all frames end with."""
        return _common([frame[::-1] for frame in self.distinct])[::-1]

    @cached_property
    def gaps(self) -> tuple[bytes, ...]:
        """What stands between frames, and behind the last; nothing in front of the first."""
        starts = [start for start, _ in self.places[1:]] + [len(self.data)]
        ends = (end for _, end in self.places)
        return tuple(self.data[end:start] for end, start in zip(ends, starts, strict=True))

    @cached_property
    def constant_bits(self) -> float:
        """How little chance it is that all frames begin and end with the same bytes, in bits.

        A byte that stands everywhere says little.
        """
        bits = 0.0
        for byte in (*self.begun, *self.ended)[: self.least]:
            elsewhere = self.data.count(byte) - len(self.places)
            bits += min(8, log2(len(self.data) / max(1, elsewhere)))
        return bits

    @property
    def constant_weight(self) -> float:
        """The same, of all frames together."""
        return self.constant_bits * len(self.places)

    def turned(self, by: int) -> Framing:
        """Return the same frames, each beginning so many bytes earlier."""
        return Framing(
            self.data,
            tuple((start - by, end - by) for start, end in self.places if start >= by),
        )

    def taking(self, before: int) -> Framing:
        """Return the frames with so many bytes more, which stand before them."""
        return Framing(
            self.data,
            tuple((start - before, end) for start, end in self.places if start >= before),
        )


def framed_by_header(data: bytes) -> list[Framing]:
    """Return the readings in which constant bytes begin frames, the best first."""
    found: dict[tuple[tuple[int, int], ...], Framing] = {}
    for header in _frequent(data):
        places = [*_places(data, header)]
        for length in _voted(data, header, places):
            framing = _settled(_chained(data, header, length))
            if framing is not None:
                found.setdefault(framing.places, framing)
    return sorted(found.values(), key=lambda each: (-each.covered, -len(each.places)))


def _common(frames: Sequence[bytes]) -> bytes:
    first = frames[0]
    for count in range(min(map(len, frames))):
        if any(frame[count] != first[count] for frame in frames):
            return first[:count]
    return min(frames, key=len)


def _frequent(data: bytes) -> Iterator[bytes]:
    """Yield the bytes, pairs and triples that stand in the data most often."""
    for size in (1, 2, 3):
        counted = Counter(data[at : at + size] for at in range(min(len(data), _VOTING) - size + 1))
        yield from (header for header, count in counted.most_common(_HEADERS) if count > 2)


def _places(data: bytes, header: bytes) -> Iterator[int]:
    at = data.find(header)
    while at >= 0:
        yield at
        at = data.find(header, at + 1)


def _voted(data: bytes, header: bytes, places: Sequence[int]) -> Iterator[LengthFit | int]:
    """Yield the lengths, or the one size, that most headers are followed by another with."""
    # A length as its offset, the number of its kind, and what it does not count.
    votes: Counter[tuple[int, int, int] | int] = Counter()
    voting = [place for place in places if place < _VOTING]
    for number, start in enumerate(voting):
        values = [
            (at, at + kind.size, which, kind.read(data, start + at))
            for at in range(len(header), len(header) + MOST_BEFORE)
            for which, kind in enumerate(KINDS)
            if start + at + kind.size <= len(data)
        ]
        for there in (*places[number + 1 : number + _NEAR], len(data)):
            gap = there - start
            if gap < LEAST_FRAME:
                continue
            votes[gap] += 1
            for at, end, which, value in values:
                if 0 <= gap - value <= MOST_UNCOUNTED and end <= gap:
                    votes[at, which, gap - value] += 1
    enough = len(voting) // 4
    for length, count in votes.most_common(_TRIED):
        if count > max(2, enough):
            yield length if isinstance(length, int) else _length(*length)


def _length(at: int, which: int, uncounted: int) -> LengthFit:
    return LengthFit(at, KINDS[which], uncounted)


def _chained(data: bytes, header: bytes, length: LengthFit | int) -> Framing:
    """Return the frames that are followed by another, or by the end."""
    places = []
    at = data.find(header)
    while at >= 0:
        size = length if isinstance(length, int) else length.size_of(data, at)
        end = 0 if size is None else at + size
        if end == len(data) or (at < end < len(data) and data.startswith(header, end)):
            places.append((at, end))
            at = end if end < len(data) else -1
        else:
            at = data.find(header, at + 1)
    return Framing(data, tuple(places))


def _settled(framing: Framing) -> Framing | None:
    """Return the reading with all constant bytes in front that are next to the beginning.

    Where the recording itself begins and ends with whole frames, that is where they do.
    """
    if len(framing.places) < 3:
        return None
    between = {*framing.gaps[:-1]}
    if len(between) == 1 and (always := len(next(iter(between)))):
        # What stands between any two frames is of one of them.
        framing = framing.taking(always)
    if framing.places[0][0] == 0 and framing.places[-1][1] == len(framing.data):
        return framing
    back = len(framing.ended)
    if back < framing.least and framing.is_joined:
        return framing.turned(back)
    return framing
