"""Noise counted by reason: neighbouring noise counts once, however the capture was cut."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...recording.layout import REASONS

if TYPE_CHECKING:
    from ...frame.errors import Reason
    from ..events import NoiseRuns


@dataclass(frozen=True, slots=True)
class NoiseOfReason:
    """The noise of one reason: its pieces, and their bytes."""

    reason: Reason
    count: int
    size: int


class NoiseCount:
    """The noise so far, without unknown frames."""

    def __init__(self) -> None:
        self._count = np.zeros(len(REASONS), np.int64)
        self._size = np.zeros(len(REASONS), np.int64)
        self._last: NoiseRuns | None = None

    def add(self, runs: NoiseRuns) -> None:
        """Take in what came next."""
        count = len(runs.frame)
        if not count:
            return
        every = runs if self._last is None else self._last.then(runs)
        is_noise = np.array([frame is None for frame in runs.frame])
        begins = is_noise & ~every.goes_on[-count:]
        self._last = runs.chosen(np.array([count - 1]))
        self._count += np.bincount(runs.reason[begins], minlength=len(REASONS))
        size = np.bincount(runs.reason[is_noise], runs.size[is_noise], minlength=len(REASONS))
        self._size += size.astype(np.int64)

    def result(self) -> list[NoiseOfReason]:
        """Return what there was, the most bytes first."""
        found = zip(REASONS, self._count.tolist(), self._size.tolist(), strict=True)
        some = [NoiseOfReason(*each) for each in found if each[1]]
        return sorted(some, key=lambda each: -each.size)
