"""Frames behind each other: of all that would be legal, those that a decoder reads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .fields import NO_KIND

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .found import Numbers
    from .legal import Judged


@dataclass(frozen=True, slots=True)
class Chain:
    """Frames in order, of which none begins before the one in front of it has ended.

    `kind` and `either` are those of Judged.
    """

    start: Numbers
    end: Numbers
    kind: NDArray[np.int16]
    either: NDArray[np.bool_]

    def chosen(self, which: Numbers | NDArray[np.bool_] | slice) -> Chain:
        """Return some of them."""
        return Chain(self.start[which], self.end[which], self.kind[which], self.either[which])


def no_chain() -> Chain:
    """Return a chain of no frames."""
    nothing = np.empty(0, np.int64)
    return Chain(nothing, nothing, np.empty(0, np.int16), np.empty(0, np.bool_))


def chained(places: Numbers, judged: Judged) -> Chain:
    """Return the frames that are read, of those that are legal at some places."""
    found = Chain(places, places + judged.size, judged.kind, judged.either)
    is_legal = judged.kind != NO_KIND
    if not is_legal.all():
        found = found.chosen(is_legal)
    is_read = first_come(found.start, found.end)
    return found if is_read.all() else found.chosen(is_read)


def first_come(start: Numbers, end: Numbers) -> NDArray[np.bool_]:
    """Tell which stretches, in their order, do not reach into one that is told before them."""
    if not (start[1:] < end[:-1]).any():
        return np.ones(len(start), np.bool_)
    # None in front of such a one reaches into it, so that it is told whatever they are.
    is_told = np.concatenate(([True], start[1:] >= np.maximum.accumulate(end)[:-1]))
    doubtful = np.flatnonzero(~is_told)
    after_told = is_told[doubtful - 1].tolist()
    bounds = end[doubtful - 1].tolist(), start[doubtful].tolist(), end[doubtful].tolist()
    told: list[bool] = []
    free_from = 0
    for is_after_told, before, begin, stop in zip(after_told, *bounds, strict=True):
        if is_after_told:
            free_from = before
        told.append(begin >= free_from)
        if told[-1]:
            free_from = stop
    is_told[doubtful] = told
    return is_told
