"""What a stretch of a capture holds: the frames and the noise, as arrays of their places."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Iterator

Bytes: TypeAlias = NDArray[np.uint8]
Numbers: TypeAlias = NDArray[np.int64]
Seconds: TypeAlias = NDArray[np.float64]

UNKNOWN_SENDER = -1
"""Stands for the direction of what either end may have sent."""


@dataclass(frozen=True, slots=True)
class Frames:
    """Frames of messages, in the order of the capture.

    `start` is where each begins in `data`, `offset` where it begins in the capture, and `kind` its
    class, an index into MESSAGES. `direction` is an index into the directions; UNKNOWN_SENDER where
    it may be of either. `time` is in seconds since the beginning of a recording, and `clock` in
    seconds since 1970, NaN where it does not say; None for a capture without times.
    """

    data: Bytes
    start: Numbers
    offset: Numbers
    size: NDArray[np.uint32]
    kind: NDArray[np.int16]
    direction: NDArray[np.int8]
    time: Seconds | None
    clock: Seconds | None

    def by_kind(self) -> Iterator[tuple[int, Frames]]:
        """Yield those of each class that there is, in the order of MESSAGES."""
        order = np.argsort(self.kind, kind="stable")
        counts = np.bincount(self.kind)
        ends = np.cumsum(counts)
        for kind in np.flatnonzero(counts).tolist():
            yield kind, self.chosen(order[ends[kind] - counts[kind] : ends[kind]])

    def chosen(self, which: Numbers) -> Frames:
        """Return those at some places of the arrays."""
        return replace(
            self,
            start=self.start[which],
            offset=self.offset[which],
            size=self.size[which],
            kind=self.kind[which],
            direction=self.direction[which],
            time=None if self.time is None else self.time[which],
            clock=None if self.clock is None else self.clock[which],
        )


@dataclass(frozen=True, slots=True)
class NoiseRuns:
    """Noise and unknown frames, in the order of the capture; neighbouring noise is one.

    `reason` is an index into Reason. `frame` holds the bytes of unknown frames, None for noise. All
    else is as in Frames.
    """

    offset: Numbers
    size: Numbers
    reason: NDArray[np.int8]
    direction: NDArray[np.int8]
    time: Seconds | None
    clock: Seconds | None
    frame: list[bytes | None]

    def chosen(self, which: Numbers) -> NoiseRuns:
        """Return those at some places of the arrays."""
        return NoiseRuns(
            self.offset[which],
            self.size[which],
            self.reason[which],
            self.direction[which],
            None if self.time is None else self.time[which],
            None if self.clock is None else self.clock[which],
            [self.frame[at] for at in which.tolist()],
        )

    @property
    def goes_on(self) -> NDArray[np.bool_]:
        """Which of them go on with the noise in front, for the same reason."""
        noise = np.array([frame is None for frame in self.frame], np.bool_)
        goes_on = np.zeros(len(noise), np.bool_)
        # Each line of a recording, which has times, stands by itself.
        if self.time is None:
            goes_on[1:] = self.offset[1:] == self.offset[:-1] + self.size[:-1]
            goes_on[1:] &= (self.reason[1:] == self.reason[:-1]) & noise[1:] & noise[:-1]
        return goes_on

    def then(self, other: NoiseRuns) -> NoiseRuns:
        """Return these, and what comes behind them."""
        return NoiseRuns(
            np.concatenate((self.offset, other.offset)),
            np.concatenate((self.size, other.size)),
            np.concatenate((self.reason, other.reason)),
            np.concatenate((self.direction, other.direction)),
            _one_after_other(self.time, len(self.frame), other.time, len(other.frame)),
            _one_after_other(self.clock, len(self.frame), other.clock, len(other.frame)),
            [*self.frame, *other.frame],
        )


@dataclass(frozen=True, slots=True)
class Events:
    """All that a stretch of a capture holds; it ends at the byte `end` of the capture."""

    frames: Frames
    noise: NoiseRuns
    end: int

    def moved(self, by: int) -> Events:
        """Return the same, so many bytes further on in the capture."""
        frames = replace(self.frames, offset=self.frames.offset + by)
        return Events(frames, replace(self.noise, offset=self.noise.offset + by), self.end + by)


def _one_after_other(
    first: Seconds | None, count: int, second: Seconds | None, other_count: int
) -> Seconds | None:
    if first is None and second is None:
        return None
    return seconds_of(first, count, second, other_count)


def seconds_of(
    first: Seconds | None, count: int, second: Seconds | None, other_count: int
) -> Seconds:
    """Return some times and others behind them; NaN for those that are not known."""
    one: Seconds = np.full(count, np.nan) if first is None else first
    other: Seconds = np.full(other_count, np.nan) if second is None else second
    return np.concatenate((one, other))
