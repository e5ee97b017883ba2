"""A servo of the bus: its settings, and how it moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lxservo.runtime import simulator

if TYPE_CHECKING:
    from collections.abc import Callable

LOWEST, CENTRE, HIGHEST = 0, 500, 1000
# 60 degrees in 0.16 s, and 240 degrees are 1000 steps.
STEPS_PER_SECOND = 1560.0


class BusServo(simulator.Travel):
    """A servo with a number: it travels to its target in the given time, holds it, or is limp.

    It is at 0 to 1000 as long as nobody turns it by hand. `dead`: it does not answer and does not
    move. What is stored survives `power_on`.
    """

    def __init__(self, servo_id: int, now: Callable[[], float], position: int = CENTRE) -> None:
        super().__init__(now, position)
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

    def move(self, position: int, time_ms: int) -> None:
        """Start to move, to be there after that time or as fast as it can, within its limits."""
        lowest, highest = self.position_limits
        self.last_move = (position, time_ms)
        self.travel(min(max(position, lowest), highest), time_ms / 1000, STEPS_PER_SECOND)
        self.loaded = True

    def start_prepared(self) -> None:
        """Start the move that was prepared."""
        self.move(*self.prepared)

    def stop(self) -> None:
        """Stay where it is, and hold that."""
        self.rest_at(self.position)

    def load(self, *, loaded: bool) -> None:
        """Hold its position, or go limp at it."""
        self.stop()
        self.loaded = loaded

    def turn_by_hand(self, position: int) -> None:
        """Turn a limp servo, even past its ends. Raises ValueError while it holds."""
        if self.loaded:
            raise ValueError(f"servo {self.servo_id} holds its position: unload it first")
        self.rest_at(position)

    def power_on(self) -> None:
        """Begin with what is stored, at the position where it is."""
        self.rest_at(self.position)
        self.offset = self.saved_offset
        self.mode, self.speed, self.loaded = 0, 0, True

    def __repr__(self) -> str:
        state = "dead" if self.dead else "holding" if self.loaded else "limp"
        return f"BusServo({self.servo_id}, {state}, position={self.position})"
