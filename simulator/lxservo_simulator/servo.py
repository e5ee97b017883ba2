"""A servo of the bus: its settings, and how it moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

LOWEST, CENTRE, HIGHEST = 0, 500, 1000
# 60 degrees in 0.16 s, and 240 degrees are 1000 steps.
STEPS_PER_SECOND = 1560.0


class BusServo:
    """A servo with a number: it travels to its target in the given time, holds it, or is limp.

    `dead`: it does not answer and does not move. What is stored survives `power_on`.
    """

    def __init__(self, servo_id: int, now: Callable[[], float], position: int = CENTRE) -> None:
        self.servo_id = servo_id
        self.dead = False
        self.temperature = 25
        self.voltage_mv = 7400
        # What it keeps when it is switched off.
        self.saved_offset = 0
        self.position_limits: tuple[int, int] = (LOWEST, HIGHEST)
        self.voltage_limits: tuple[int, int] = (4500, 12000)
        self.temperature_limit = 85
        self.led = 0
        self.led_errors = 7
        # What it does not.
        self.offset = 0
        self.mode, self.speed = 0, 0
        self.loaded = True
        self.last_move: tuple[int, int] = (position, 0)
        self.prepared: tuple[int, int] = (position, 0)
        self._now = now
        self._start = self._target = position
        self._left = self._arrives = now()

    @property
    def position(self) -> int:
        """Where it is now: 0 to 1000 as long as nobody turns it by hand."""
        if not self.travelling:
            return self._target
        share = (self._now() - self._left) / (self._arrives - self._left)
        return round(self._start + (self._target - self._start) * share)

    @property
    def travelling(self) -> bool:
        """Whether it is moving."""
        return self._now() < self._arrives

    def move(self, position: int, time_ms: int) -> None:
        """Start to move, to be there after that time or as fast as it can, within its limits."""
        lowest, highest = self.position_limits
        self.last_move = (position, time_ms)
        self._start = self.position
        self._target = min(max(position, lowest), highest)
        self._left = self._now()
        fastest = abs(self._target - self._start) / STEPS_PER_SECOND
        self._arrives = self._left + max(time_ms / 1000, fastest)
        self.loaded = True

    def start_prepared(self) -> None:
        """Start the move that was prepared."""
        self.move(*self.prepared)

    def stop(self) -> None:
        """Stay where it is, and hold that."""
        self._rest_at(self.position)

    def load(self, *, loaded: bool) -> None:
        """Hold its position, or go limp at it."""
        self.stop()
        self.loaded = loaded

    def turn_by_hand(self, position: int) -> None:
        """Turn a limp servo, even past its ends. Raises ValueError while it holds."""
        if self.loaded:
            raise ValueError(f"servo {self.servo_id} holds its position: unload it first")
        self._rest_at(position)

    def power_on(self) -> None:
        """Begin with what is stored, at the position where it is."""
        self._rest_at(self.position)
        self.offset = self.saved_offset
        self.mode, self.speed, self.loaded = 0, 0, True

    def _rest_at(self, position: int) -> None:
        self._target = position
        self._arrives = self._now()

    def __repr__(self) -> str:
        state = "dead" if self.dead else "holding" if self.loaded else "limp"
        return f"BusServo({self.servo_id}, {state}, position={self.position})"
