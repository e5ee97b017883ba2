"""Which bytes say what a frame is: those that its size goes with."""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass
from math import log2
from random import Random
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Sequence

# By chance, shuffled values go with the sizes as well as these do once in so many times.
_SHUFFLES = 99
# So much of what there is to know about sizes has to follow from an id.
_ENOUGH = 0.25
# No protocol has more messages, and few captures show so many.
MOST_MESSAGES = 64


@dataclass(frozen=True)
class IdFit:
    """The offsets of bytes that say what a frame is, and of those that may say it, too.

    Decided are those that the sizes of frames go with while they go with no other byte.
    """

    offsets: tuple[int, ...]
    rivals: tuple[int, ...] = ()

    @property
    def is_decided(self) -> bool:
        """Whether nothing else may be an id."""
        return bool(self.offsets) and not self.rivals


def id_fit(frames: Sequence[bytes], candidates: Sequence[int]) -> IdFit:
    """Return which of some offsets hold an id. No offset is decided that another may stand for."""
    sizes = [len(frame) for frame in frames]
    gains = {
        at: _gain(sizes, [frame[at] for frame in frames], [0] * len(frames)) for at in candidates
    }
    best = max(gains, key=lambda at: gains[at], default=None)
    if best is None or gains[best] <= 0:
        return IdFit(())
    if gains[best] < _ENOUGH * _unknown(sizes, [0] * len(sizes)):
        return IdFit((), (best,))
    rivals = tuple(
        at
        for at in candidates
        if at != best
        and (
            _goes_with(frames, sizes, at, given=best) > 0
            # As where each device sends a message of its own.
            or (gains[at] > 0 and _goes_with(frames, sizes, best, given=at) <= 0)
        )
    )
    chosen = [best]
    for at in rivals:
        if len({tuple(frame[each] for each in (*chosen, at)) for frame in frames}) <= MOST_MESSAGES:
            chosen.append(at)
    return IdFit(tuple(sorted(chosen)), rivals)


def _goes_with(frames: Sequence[bytes], sizes: Sequence[int], at: int, *, given: int) -> float:
    """Return how much a byte says of the size where the one at `given` has said what it can.

    Where the size grows with it, step by step, it is a count.
    """
    groups: dict[int, list[tuple[int, int]]] = defaultdict(list)
    for frame, size in zip(frames, sizes, strict=True):
        groups[frame[given]].append((size, frame[at]))
    kept = [
        (size, value, key)
        for key, group in groups.items()
        if not _is_count(group)
        for size, value in group
    ]
    if not kept:
        return 0
    return _gain(*map(list, zip(*kept, strict=True)))


def _is_count(group: Iterable[tuple[int, int]]) -> bool:
    """Return whether sizes are in step with values."""
    points = sorted({(value, size) for size, value in group})
    if len({size for _, size in points}) == 1:
        return True
    if len(points) < 2 or len({value for value, _ in points}) < len(points):
        return False
    (low, least), (high, most) = points[0], points[-1]
    return most > least and all(
        (size - least) * (high - low) == (value - low) * (most - least) for value, size in points
    )


def _gain(sizes: list[int], values: list[int], groups: list[int]) -> float:
    """Return by how many bits values say more of sizes, within groups, than shuffled ones do."""
    chance = Random(1)  # noqa: S311 - to be the same each time
    said = _said(sizes, values, groups)
    members: dict[int, list[int]] = defaultdict(list)
    for number, group in enumerate(groups):
        members[group].append(number)
    shuffled = 0.0
    for _ in range(_SHUFFLES):
        other = values[:]
        for numbers in members.values():
            taken = [values[number] for number in numbers]
            chance.shuffle(taken)
            for number, value in zip(numbers, taken, strict=True):
                other[number] = value
        by_chance = _said(sizes, other, groups)
        # One that says as much is enough, and most bytes meet it soon.
        if said <= by_chance + 1e-9:
            return 0
        shuffled += by_chance
    return said - shuffled / _SHUFFLES


def _said(sizes: Sequence[int], values: Sequence[int], groups: Sequence[int]) -> float:
    """Return how many bits of the sizes values say, within groups."""
    pairs = list(zip(values, groups, strict=True))
    return _unknown(sizes, groups) - _unknown(sizes, pairs)


def _unknown(sizes: Sequence[int], known: Sequence[Hashable]) -> float:
    """Return how many bits of the sizes remain unknown, on average."""
    together = Counter(zip(sizes, known, strict=True))
    alone = Counter(known)
    return sum(count * log2(alone[key] / count) for (_, key), count in together.items()) / len(
        sizes
    )
