"""A way to a target, in a given time: where something is that moves at an even pace."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


class Travel:
    """What stands at a position until it is told to move. `now` returns the time in seconds."""

    def __init__(self, now: Callable[[], float], position: int) -> None:
        self.target = position
        self._now = now
        self._start = position
        self._left = self._arrives = now()

    @property
    def position(self) -> int:
        """Where it is now."""
        if not self.travelling:
            return self.target
        share = (self._now() - self._left) / (self._arrives - self._left)
        return round(self._start + (self.target - self._start) * share)

    @property
    def travelling(self) -> bool:
        """Whether it is moving."""
        return self._now() < self._arrives

    def travel(self, target: int, seconds: float, per_second: float) -> None:
        """Start to move, to be there after `seconds`, or as fast as `per_second` allows."""
        self._start = self.position
        self.target = target
        self._left = self._now()
        self._arrives = self._left + max(seconds, abs(target - self._start) / per_second)

    def rest_at(self, position: int) -> None:
        """Be at a position at once, and stay there."""
        self.target = position
        self._arrives = self._now()

    def busy(self, since: float, until: float) -> float:
        """Return for how many seconds of that time it is moving."""
        return max(0.0, min(self._arrives, until) - max(self._left, since))
