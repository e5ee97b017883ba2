"""One quantity over time, thinned to what a drawing can show, in bounded memory.

Time is cut into buckets, which double as it goes on. Each keeps its first, lowest, highest and last
value, and the mean: a line through the first four covers the same pixels as one through all values.
Where a bucket holds many, that line is a solid block, and a band with its means says more.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..events import Numbers, Seconds

BUCKETS = 1024
"""How many buckets a trace has at most; it has four times as many points."""

_Values: TypeAlias = "NDArray[np.float64]"
_SHORTEST = 1e-6
# From so many values a bucket on, a line through its four hides where most of them are.
_DENSE = 8


@dataclass(slots=True)
class _Buckets:
    """What some stretches of time hold; absent values follow where there is a `gap`."""

    first_at: Seconds
    first: _Values
    low: _Values
    high: _Values
    last_at: Seconds
    last: _Values
    gap: NDArray[np.bool_]
    total: _Values
    count: Numbers

    def merged(self, number: Numbers) -> _Buckets:
        """Return them with those of the same number as one; the numbers never go back."""
        begins = np.flatnonzero(np.concatenate(([True], number[1:] != number[:-1])))
        ends = np.concatenate((begins[1:], [len(number)])) - 1
        return _Buckets(
            self.first_at[begins],
            self.first[begins],
            np.minimum.reduceat(self.low, begins),
            np.maximum.reduceat(self.high, begins),
            self.last_at[ends],
            self.last[ends],
            np.logical_or.reduceat(self.gap, begins),
            np.add.reduceat(self.total, begins),
            np.add.reduceat(self.count, begins),
        )

    def followed_by(self, other: _Buckets) -> _Buckets:
        """Return these and others behind them."""
        names = self.__slots__
        pairs = [np.concatenate((getattr(self, name), getattr(other, name))) for name in names]
        return _Buckets(*pairs)


class Trace:
    """The values of one thing over time."""

    def __init__(self) -> None:
        self.count = 0
        self._width = _SHORTEST
        self._began: float | None = None
        self._buckets: _Buckets | None = None

    def add(self, seconds: Seconds, values: _Values) -> None:
        """Take in values with their times, which never go back; NaN stands for none."""
        there = ~np.isnan(values)
        self.count += int(there.sum())
        # A value is followed by a gap if the next one is absent.
        gap = np.concatenate((~there[1:], [False]))[there]
        begins_with_gap = len(there) > 0 and not there[0]
        if begins_with_gap and self._buckets is not None:
            self._buckets.gap[-1] = True
        seconds, values = seconds[there], values[there]
        if not len(values):
            return
        if self._began is None:
            self._began = float(seconds[0])
        each = np.ones(len(values), np.int64)
        made = _Buckets(seconds, values, values, values, seconds, values, gap, values, each)
        if self._buckets is not None:
            made = self._buckets.followed_by(made)
        length = float(made.last_at[-1]) - self._began
        while length >= self._width * BUCKETS:
            self._width *= 2
        number = ((made.first_at - self._began) / self._width).astype(np.int64)
        self._buckets = made.merged(number)

    @property
    def is_dense(self) -> bool:
        """Whether there are so many values that a band shows more than a line through them."""
        return self._buckets is not None and self.count >= _DENSE * len(self._buckets.count)

    def band(self) -> tuple[Seconds, _Values, _Values, _Values]:
        """Return times with the lowest, mean and highest value around each; NaN where it is torn.

        A bucket in which values are absent still counts, and the band is torn behind it.
        """
        found = self._buckets
        if found is None:
            return np.empty(0), np.empty(0), np.empty(0), np.empty(0)
        # Rounding must not take a mean out of its band: of equal values it is that value.
        mean = np.clip(found.total / found.count, found.low, found.high)
        behind = np.flatnonzero(found.gap) + 1
        at = np.insert((found.first_at + found.last_at) / 2, behind, found.last_at[behind - 1])
        low, mid, high = (np.insert(v, behind, np.nan) for v in (found.low, mean, found.high))
        return at, low, mid, high

    def points(self) -> tuple[Seconds, _Values]:
        """Return the points of a line, in order; NaN where it is interrupted."""
        found = self._buckets
        if found is None:
            return np.empty(0), np.empty(0)
        rises = found.last >= found.first
        middle = (found.first_at + found.last_at) / 2
        end = np.where(found.gap, np.nan, found.last)
        one = np.where(rises, found.low, found.high)
        other = np.where(rises, found.high, found.low)
        # Where the first or the last is an extreme, no point between them is needed for it.
        one_at = np.where(one == found.first, found.first_at, middle)
        other_at = np.where(other == found.last, found.last_at, middle)
        at = np.stack([found.first_at, one_at, other_at, found.last_at, found.last_at], axis=1)
        value = np.stack([found.first, one, other, found.last, end], axis=1)
        flat_at, flat = at.reshape(-1), value.reshape(-1)
        same = (flat_at[1:] == flat_at[:-1]) & (flat[1:] == flat[:-1])
        kept = np.concatenate(([True], ~same))
        return flat_at[kept], flat[kept]


def alone(values: _Values) -> Numbers:
    """Return the places of the values that stand between two gaps: no line goes through them."""
    gap = np.concatenate(([True], np.isnan(values), [True]))
    return np.flatnonzero(~gap[1:-1] & gap[:-2] & gap[2:])
