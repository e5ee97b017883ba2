"""The time on the board: real time, or a time that a test advances."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable


class Clock(Protocol):
    """Any clock that counts seconds, and never goes back."""

    def now(self) -> float:
        """Return the time in seconds, counted from anywhere."""
        ...


class RealClock:
    """Real time."""

    def now(self) -> float:
        """Return seconds, as `time.monotonic` has them."""
        return time.monotonic()


class VirtualClock:
    """A time that stands still until it is advanced.

    With `follow_reads`, a `read` of an in-process transport advances it, to the moment at which
    bytes arrive or the wait ends: for programs of one thread.
    """

    def __init__(self, *, follow_reads: bool = False) -> None:
        self.follow_reads = follow_reads
        self._now = 0.0
        self._listeners: list[Callable[[], None]] = []
        self._sources: list[Callable[[], float | None]] = []

    def now(self) -> float:
        """Return the seconds since it was made."""
        return self._now

    def advance(self, seconds: float) -> None:
        """Advance the time. Raises ValueError for a negative number."""
        if not seconds >= 0:
            raise ValueError(f"time goes on by 0 s or more, not by {seconds}")
        self.move_to(self._now + seconds)

    def move_to(self, moment: float) -> None:
        """Advance the time to a moment; one that has passed changes nothing."""
        self._now = max(self._now, moment)
        for listener in self._listeners:
            listener()

    def when_moved(self, listener: Callable[[], None]) -> None:
        """Call `listener` from now on whenever the time has moved."""
        self._listeners.append(listener)

    @property
    def next_event(self) -> float | None:
        """When something happens next on what lives by this clock; None while nothing will."""
        moments = [source() for source in self._sources]
        return min((moment for moment in moments if moment is not None), default=None)

    def when_due(self, source: Callable[[], float | None]) -> None:
        """Ask `source` from now on for the moment at which something happens next, or None."""
        self._sources.append(source)
