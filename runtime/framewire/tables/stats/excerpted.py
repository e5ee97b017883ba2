"""The events of a part of a capture, chosen by when they came."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...recording.excerpt import ExcerptError
from .timeline import Timeline

if TYPE_CHECKING:
    from ...recording.excerpt import Excerpt
    from ..events import Events
    from .timeline import Moments


class Excerpted:
    """Chooses what lies in an excerpt, stretch by stretch. Raises ExcerptError."""

    def __init__(self, excerpt: Excerpt) -> None:
        self._excerpt = excerpt
        self._whole = Timeline()
        self._is_empty = True

    def chosen(self, stretch: Events, moments: Moments | None) -> tuple[Events, Moments]:
        """Return those events of a stretch that lie in it, and when they came."""
        if moments is None:
            raise ExcerptError(f"it holds no times, so it has no part {self._excerpt.words}")
        self._whole.add(stretch, moments)
        low, high = self._excerpt.bounds(clock=False)
        inside = (moments.seconds >= low) & (moments.seconds <= high)
        if self._excerpt.needs_clock:
            if np.isnan(moments.clock).any():
                raise ExcerptError("it does not say when it began: give seconds since then")
            low, high = self._excerpt.bounds(clock=True)
            inside &= (moments.clock >= low) & (moments.clock <= high)
        which = np.flatnonzero(inside)
        self._is_empty = self._is_empty and not len(which)
        count = len(stretch.frames.offset)
        frames = stretch.frames.chosen(which[which < count])
        noise = stretch.noise.chosen(which[which >= count] - count)
        return type(stretch)(frames, noise, stretch.end), moments.chosen(which)

    def end(self) -> None:
        """Refuse an excerpt in which nothing lies."""
        whole = self._whole
        if not self._is_empty:
            return
        if whole.first is None:
            raise ExcerptError(f"it holds no event, so it has no part {self._excerpt.words}")
        clock = None
        if whole.began is not None and whole.ended is not None:
            clock = whole.began, whole.ended
        self._excerpt.refuse((whole.first, whole.last), clock)
