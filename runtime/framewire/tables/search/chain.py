"""Frames behind each other: of all that would be legal, those that a decoder reads."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .fields import NO_KIND

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..events import Numbers
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
    return found.chosen(first_come(found.start, found.end))


def first_come(start: Numbers, end: Numbers) -> NDArray[np.bool_] | slice:
    """Return which stretches are left if each gives way to those in front that reach into it.

    They are sorted by where they begin.
    """
    if not (start[1:] < end[:-1]).any():
        return slice(None)
    # Into these nothing reaches, whatever else gives way.
    is_left = np.concatenate(([True], start[1:] >= np.maximum.accumulate(end)[:-1]))
    doubtful = np.flatnonzero(~is_left)
    after_left = is_left[doubtful - 1].tolist()
    bounds = end[doubtful - 1].tolist(), start[doubtful].tolist(), end[doubtful].tolist()
    found: list[bool] = []
    reached = 0
    for is_after_left, before, begin, until in zip(after_left, *bounds, strict=True):
        if is_after_left:
            reached = before
        found.append(begin >= reached)
        if found[-1]:
            reached = until
    is_left[doubtful] = found
    return is_left
