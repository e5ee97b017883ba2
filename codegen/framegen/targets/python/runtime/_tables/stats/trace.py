"""One quantity over time, thinned to what a drawing can show, in bounded memory.

Time is cut into buckets, which double as it goes on. Each keeps its first, lowest, highest and last
value: a line through these covers the same pixels as a line through all of them.
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
        made = _Buckets(seconds, values, values, values, seconds, values, gap)
        if self._buckets is not None:
            made = self._buckets.followed_by(made)
        length = float(made.last_at[-1]) - self._began
        while length >= self._width * BUCKETS:
            self._width *= 2
        number = ((made.first_at - self._began) / self._width).astype(np.int64)
        self._buckets = made.merged(number)

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
