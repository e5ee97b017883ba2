"""The times of a recording as one line, also where several recordings stand behind each other."""

from __future__ import annotations

import heapq
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..events import seconds_of

if TYPE_CHECKING:
    from ..events import Events, Numbers, Seconds

# Recordings whose clocks differ by more are two; so are those whose times go back by more.
_ANOTHER_CLOCK, _BACK = 1e-3, 1.0
_SILENCES = 5
# Up to so many distances are kept as they are; more are counted in steps of about 1 %.
_EXACT = 4096
_STEPS, _SHORTEST, _OCTAVES = 70, 1e-7, 64


@dataclass(frozen=True, slots=True)
class Silence:
    """A time in which nothing came: how long, from when on, and the byte that ended it."""

    seconds: float
    time: float
    offset: int


@dataclass(frozen=True, slots=True)
class Moments:
    """When the events of a stretch came: seconds on the line of time, and in which recording."""

    seconds: Seconds
    recording: Numbers

    def chosen(self, which: Numbers) -> Moments:
        """Return some of them."""
        return Moments(self.seconds[which], self.recording[which])


@dataclass(slots=True)
class Timeline:
    """The time from the first event on, without the time between two recordings."""

    first: float | None = None
    last: float = 0.0
    began: float | None = None
    recordings: int = 0
    silences: list[Silence] = field(default_factory=list)
    _time: float = 0.0
    _clock: float = np.nan

    @property
    def seconds(self) -> float | None:
        """How long the recordings are together; None without times."""
        return None if self.first is None else self.last - self.first

    def add(self, stretch: Events) -> Moments | None:
        """Take in the events of a stretch; return when its frames came, None without times."""
        frames, runs = stretch.frames, stretch.noise
        if frames.time is None and runs.time is None:
            return None
        count = len(frames.offset)
        offset = np.concatenate((frames.offset, runs.offset))
        order = np.argsort(offset, kind="stable")
        time = seconds_of(frames.time, count, runs.time, len(runs.offset))[order]
        if np.isnan(time).any():
            return None
        clock = seconds_of(frames.clock, count, runs.clock, len(runs.offset))[order] - time
        if self.first is None:
            self.first = self.last = self._time = float(time[0])
            self.began = None if np.isnan(clock[0]) else float(clock[0] + time[0])
            self._clock, self.recordings = float(clock[0]), 1
        placed = self._placed(time, clock)
        self._note_silences(placed, offset[order])
        self.last, self._time, self._clock = float(placed.seconds[-1]), time[-1], clock[-1]
        back = np.empty_like(order)
        back[order] = np.arange(len(order))
        return placed.chosen(back[:count])

    def _placed(self, time: Seconds, clock: Seconds) -> Moments:
        before = np.concatenate(([self._time], time[:-1]))
        clock_before = np.concatenate(([self._clock], clock[:-1]))
        is_known = ~np.isnan(clock) & ~np.isnan(clock_before)
        is_new = np.where(
            is_known, np.abs(clock - clock_before) > _ANOTHER_CLOCK, time < before - _BACK
        )
        numbers = self.recordings - 1 + np.cumsum(is_new)
        seconds = np.empty_like(time)
        bounds = [0, *np.flatnonzero(is_new).tolist(), len(time)]
        at, begins = self.last, self._time
        for start, end in pairwise(bounds):
            if start == end:
                continue
            if is_new[start]:
                begins = float(time[start])
            since = np.maximum(time[start:end] - begins, 0)
            seconds[start:end] = at + np.maximum.accumulate(since)
            at = float(seconds[end - 1])
        self.recordings = int(numbers[-1]) + 1
        return Moments(seconds, numbers)

    def _note_silences(self, placed: Moments, offset: Numbers) -> None:
        before = np.concatenate(([self.last], placed.seconds[:-1]))
        long = placed.seconds - before
        for at in np.argsort(-long, kind="stable")[:_SILENCES].tolist():
            if long[at] > 0:
                self.silences.append(Silence(float(long[at]), float(before[at]), int(offset[at])))
        self.silences = heapq.nsmallest(_SILENCES, self.silences, lambda s: (-s.seconds, s.offset))


class Intervals:
    """The times between the events of one kind: the longest and, to about 1 %, the median."""

    def __init__(self) -> None:
        self.longest: float | None = None
        self._last: tuple[float, int] | None = None
        self._some: list[float] = []
        self._counts: Numbers | None = None

    def add(self, moments: Moments) -> None:
        """Take in when the next of them came."""
        seconds, recording = moments.seconds, moments.recording
        if not len(seconds):
            return
        if self._last is not None:
            seconds = np.concatenate(([self._last[0]], seconds))
            recording = np.concatenate(([self._last[1]], recording))
        self._last = float(seconds[-1]), int(recording[-1])
        between = np.diff(seconds)[np.diff(recording) == 0]
        if not len(between):
            return
        self.longest = max(self.longest or 0.0, float(between.max()))
        if self._counts is None and len(self._some) + len(between) <= _EXACT:
            self._some += between.tolist()
            return
        if self._counts is None:
            self._counts = _counted(np.array(self._some))
        self._counts += _counted(between)

    @property
    def median(self) -> float | None:
        """Half of them are shorter; None if there are none."""
        if self._counts is None:
            return float(np.median(self._some)) if self._some else None
        half = np.searchsorted(np.cumsum(self._counts), self._counts.sum() / 2)
        return float(_SHORTEST * 2 ** ((half + 0.5) / _STEPS)) if half else 0.0


def _counted(between: Seconds) -> Numbers:
    """Count times by their size."""
    steps = np.log2(np.maximum(between, _SHORTEST) / _SHORTEST) * _STEPS
    places = np.minimum(steps.astype(np.int64), _OCTAVES * _STEPS - 1)
    return np.bincount(places, minlength=_OCTAVES * _STEPS)
