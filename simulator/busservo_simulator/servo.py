"""A servo: travels to its target in the given time, holds it, or is limp."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

LOWEST, CENTRE, HIGHEST = 0, 500, 1000
# A hobby bus servo turns 60 degrees in 0.16 s, and 240 degrees are 1000 steps.
STEPS_PER_SECOND = 1560.0


class Servo:
    """A servo of the bus.

    `missing`: there is no servo of this number. `off`: it does not answer, but the board lists it.
    """

    def __init__(self, servo_id: int, now: Callable[[], float], position: int = CENTRE) -> None:
        self.servo_id = servo_id
        self.missing = False
        self.off = False
        self.loaded = True
        self.target = position
        self._now = now
        self._start = position
        self._left = self._arrives = now()

    @property
    def position(self) -> int:
        """Where it is now: 0 to 1000."""
        if not self.travelling:
            return self.target
        share = (self._now() - self._left) / (self._arrives - self._left)
        return round(self._start + (self.target - self._start) * share)

    @property
    def travelling(self) -> bool:
        """Whether it is moving."""
        return self._now() < self._arrives

    def move(self, position: int, seconds: float) -> None:
        """Start to move to `position`, to be there after `seconds` or as fast as it can.

        For a position out of reach, it moves as far as the servo goes.
        """
        self._start = self.position
        self.target = min(max(position, LOWEST), HIGHEST)
        self._left = self._now()
        fastest = abs(self.target - self._start) / STEPS_PER_SECOND
        self._arrives = self._left + max(seconds, fastest)
        self.loaded = True

    def unload(self) -> None:
        """Go limp at the present position."""
        self._rest_at(self.position)
        self.loaded = False

    def turn_by_hand(self, position: int) -> None:
        """Turn a limp servo. Raises ValueError while it holds."""
        if self.loaded:
            raise ValueError(f"servo {self.servo_id} holds its position: unload it first")
        self._rest_at(min(max(position, LOWEST), HIGHEST))

    def busy(self, since: float, until: float) -> float:
        """Return for how many seconds of that time it is moving."""
        return max(0.0, min(self._arrives, until) - max(self._left, since))

    def _rest_at(self, position: int) -> None:
        self.target = position
        self._arrives = self._now()

    def __repr__(self) -> str:
        state = "missing" if self.missing else "off" if self.off else ""
        state = state or ("holding" if self.loaded else "limp")
        return f"Servo({self.servo_id}, {state}, position={self.position})"
