"""Noise counted by reason: neighbouring noise counts once, however the capture was cut."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..._frame.errors import Reason

if TYPE_CHECKING:
    from ..events import NoiseRuns

_REASONS = [*Reason]


@dataclass(frozen=True, slots=True)
class NoiseOfReason:
    """The noise of one reason: its pieces, and their bytes."""

    reason: Reason
    count: int
    size: int


class NoiseCount:
    """The noise so far, without unknown frames."""

    def __init__(self) -> None:
        self._count = np.zeros(len(_REASONS), np.int64)
        self._size = np.zeros(len(_REASONS), np.int64)
        # Where the last piece ended, why it was noise, and of which direction.
        self._last = -1, -1, -1

    def add(self, runs: NoiseRuns) -> None:
        """Take in what came next."""
        noise = np.flatnonzero([frame is None for frame in runs.frame])
        if not len(noise):
            return
        end = runs.offset[noise] + runs.size[noise]
        reason, direction = runs.reason[noise], runs.direction[noise]
        last_end, last_reason, last_direction = self._last
        goes_on = runs.offset[noise] == np.concatenate(([last_end], end[:-1]))
        goes_on &= reason == np.concatenate(([last_reason], reason[:-1]))
        goes_on &= direction == np.concatenate(([last_direction], direction[:-1]))
        # Bytes of two lines of a recording are not joined.
        goes_on &= runs.time is None or np.isnan(runs.time[noise])
        self._last = int(end[-1]), int(reason[-1]), int(direction[-1])
        self._count += np.bincount(reason[~goes_on], minlength=len(_REASONS))
        size = np.bincount(reason, runs.size[noise], minlength=len(_REASONS))
        self._size += size.astype(np.int64)

    def result(self) -> list[NoiseOfReason]:
        """Return what there was, the most bytes first."""
        found = zip(_REASONS, self._count.tolist(), self._size.tolist(), strict=True)
        some = [NoiseOfReason(*each) for each in found if each[1]]
        return sorted(some, key=lambda each: -each.size)
