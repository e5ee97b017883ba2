"""What a stretch of a capture holds: the frames and the noise, as arrays of their places."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

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
    it may be of either. `time` is in seconds since the beginning of a recording, `clock` in seconds
    since 1970, and NaN where the capture does not say.
    """

    data: Bytes
    start: Numbers
    offset: Numbers
    size: Numbers
    kind: Numbers
    direction: Numbers
    time: Seconds
    clock: Seconds

    def of(self, kind: int) -> Frames:
        """Return those of one class."""
        return self.chosen(np.flatnonzero(self.kind == kind))

    def chosen(self, which: Numbers) -> Frames:
        """Return those at some places of the arrays."""
        return replace(
            self,
            start=self.start[which],
            offset=self.offset[which],
            size=self.size[which],
            kind=self.kind[which],
            direction=self.direction[which],
            time=self.time[which],
            clock=self.clock[which],
        )


@dataclass(frozen=True, slots=True)
class Stray:
    """Noise and unknown frames, in the order of the capture; neighbouring noise is one.

    `reason` is an index into Reason. `frame` holds the bytes of unknown frames, None for noise. All
    else is as in Frames.
    """

    offset: Numbers
    size: Numbers
    reason: Numbers
    direction: Numbers
    time: Seconds
    clock: Seconds
    frame: list[bytes | None]


@dataclass(frozen=True, slots=True)
class Found:
    """All that a stretch of a capture holds; it ends at the byte `end` of the capture."""

    frames: Frames
    stray: Stray
    end: int

    def moved(self, by: int) -> Found:
        """Return the same, so many bytes further on in the capture."""
        frames = replace(self.frames, offset=self.frames.offset + by)
        return Found(frames, replace(self.stray, offset=self.stray.offset + by), self.end + by)


def unknown_times(count: int) -> Seconds:
    """Return the times of events of which the capture says none."""
    return np.full(count, np.nan)
