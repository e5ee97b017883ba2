"""What time it is on the board: the world's, or one that a test moves on by hand."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable


class Clock(Protocol):
    """Anything that tells seconds, and never goes back."""

    def now(self) -> float:
        """The time in seconds, counted from anywhere."""
        ...


class RealClock:
    """The world's time."""

    def now(self) -> float:
        """Seconds, as `time.monotonic` has them."""
        return time.monotonic()


class VirtualClock:
    """A time that stands still until it is moved on.

    With `follow_reads`, whoever waits in the `read` of an in-process transport moves it on, to the
    moment at which something arrives or the wait ends: for programs of one thread.
    """

    def __init__(self, *, follow_reads: bool = False) -> None:
        self.follow_reads = follow_reads
        self._now = 0.0
        self._listeners: list[Callable[[], None]] = []

    def now(self) -> float:
        """Seconds since it was made."""
        return self._now

    def advance(self, seconds: float) -> None:
        """Moves the time on. Raises ValueError for less than nothing."""
        if not seconds >= 0:
            raise ValueError(f"time goes on by 0 s or more, not by {seconds}")
        self.move_to(self._now + seconds)

    def move_to(self, moment: float) -> None:
        """Moves the time on to a moment; one that has passed changes nothing."""
        self._now = max(self._now, moment)
        for listener in self._listeners:
            listener()

    def when_moved(self, listener: Callable[[], None]) -> None:
        """Has `listener` called whenever the time has moved."""
        self._listeners.append(listener)
