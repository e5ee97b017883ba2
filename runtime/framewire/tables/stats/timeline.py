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
    """When the events of a stretch came: seconds on the line of time, and in which recording.

    `clock` is the time of day, in seconds since 1970; NaN where it is not known.
    """

    seconds: Seconds
    recording: Numbers
    clock: Seconds

    def chosen(self, which: Numbers) -> Moments:
        """Return some of them."""
        return Moments(self.seconds[which], self.recording[which], self.clock[which])


class Clockwork:
    """Places events on one line of time, without the time between two recordings."""

    def __init__(self) -> None:
        self._last: float | None = None
        self._time = 0.0
        self._clock = np.nan
        self._number = 0
        # Where the present recording begins: by its own times, and on the line.
        self._begins = self._base = 0.0

    def moments(self, stretch: Events) -> Moments | None:
        """Return when the frames of a stretch came, and then its noise; None without times."""
        frames, runs = stretch.frames, stretch.noise
        if frames.time is None and runs.time is None:
            return None
        count = len(frames.offset)
        order = _in_order(stretch)
        time = seconds_of(frames.time, count, runs.time, len(runs.offset))[order]
        if np.isnan(time).any():
            return None
        clock = seconds_of(frames.clock, count, runs.clock, len(runs.offset))[order] - time
        if self._last is None:
            self._last = self._time = self._begins = self._base = float(time[0])
            self._clock = float(clock[0])
        placed = self._placed(time, clock, self._last)
        self._last, self._time = float(placed.seconds[-1]), float(time[-1])
        self._clock, self._number = float(clock[-1]), int(placed.recording[-1])
        back = np.empty_like(order)
        back[order] = np.arange(len(order))
        return placed.chosen(back)

    def _placed(self, time: Seconds, clock: Seconds, at: float) -> Moments:
        before = np.concatenate(([self._time], time[:-1]))
        clock_before = np.concatenate(([self._clock], clock[:-1]))
        is_known = ~np.isnan(clock) & ~np.isnan(clock_before)
        is_new = np.where(
            is_known, np.abs(clock - clock_before) > _ANOTHER_CLOCK, time < before - _BACK
        )
        seconds = np.empty_like(time)
        bounds = [0, *np.flatnonzero(is_new).tolist(), len(time)]
        for start, end in pairwise(bounds):
            if start == end:
                continue
            if is_new[start]:
                self._begins, self._base = float(time[start]), at
            reached = np.maximum.accumulate(self._base + (time[start:end] - self._begins))
            seconds[start:end] = np.maximum(reached, at)
            at = float(seconds[end - 1])
        return Moments(seconds, self._number + np.cumsum(is_new), clock + time)


@dataclass(slots=True)
class Timeline:
    """The time from the first event to the last, and the longest silences in it."""

    first: float | None = None
    last: float = 0.0
    began: float | None = None
    ended: float | None = None
    recordings: int = 0
    silences: list[Silence] = field(default_factory=list)
    _recording: int = -1

    @property
    def seconds(self) -> float | None:
        """How long the recordings are together; None without times."""
        return None if self.first is None else self.last - self.first

    def add(self, stretch: Events, moments: Moments) -> None:
        """Take in the events of a stretch, and when they came."""
        order = _in_order(stretch)
        placed = moments.chosen(order)
        if not len(order):
            return
        if self.first is None:
            self.first = self.last = float(placed.seconds[0])
            self.began = _known(placed.clock[0])
        offset = np.concatenate((stretch.frames.offset, stretch.noise.offset))
        self._note_silences(placed, offset[order])
        numbers = np.concatenate(([self._recording], placed.recording))
        self.recordings += int((np.diff(numbers) != 0).sum())
        self._recording = int(numbers[-1])
        self.last, self.ended = float(placed.seconds[-1]), _known(placed.clock[-1])

    def _note_silences(self, placed: Moments, offset: Numbers) -> None:
        before = np.concatenate(([self.last], placed.seconds[:-1]))
        long = placed.seconds - before
        for at in np.argsort(-long, kind="stable")[:_SILENCES].tolist():
            if long[at] > 0:
                self.silences.append(Silence(float(long[at]), float(before[at]), int(offset[at])))
        self.silences = heapq.nsmallest(_SILENCES, self.silences, lambda s: (-s.seconds, s.offset))


def _in_order(stretch: Events) -> Numbers:
    """Return the places of the frames, and of the noise behind them, as the capture has them."""
    offset = np.concatenate((stretch.frames.offset, stretch.noise.offset))
    return np.argsort(offset, kind="stable")


def _known(clock: float) -> float | None:
    return None if np.isnan(clock) else float(clock)


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
