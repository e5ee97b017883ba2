"""A servo: travels to its target in the given time, holds it, or is limp."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.simulator.travel import Travel

if TYPE_CHECKING:
    from collections.abc import Callable

LOWEST, CENTRE, HIGHEST = 0, 500, 1000
# A hobby bus servo turns 60 degrees in 0.16 s, and 240 degrees are 1000 steps.
STEPS_PER_SECOND = 1560.0


class Servo(Travel):
    """A servo of the bus, at a position from 0 to 1000.

    `missing`: there is no servo of this number. `off`: it does not answer, but the board lists it.
    """

    def __init__(self, servo_id: int, now: Callable[[], float], position: int = CENTRE) -> None:
        super().__init__(now, position)
        self.servo_id = servo_id
        self.missing = False
        self.off = False
        self.loaded = True

    def move(self, position: int, seconds: float) -> None:
        """Start to move to `position`, to be there after `seconds` or as fast as it can.

        For a position out of reach, it moves as far as the servo goes.
        """
        self.travel(_within_reach(position), seconds, STEPS_PER_SECOND)
        self.loaded = True

    def unload(self) -> None:
        """Go limp at the present position."""
        self.rest_at(self.position)
        self.loaded = False

    def turn_by_hand(self, position: int) -> None:
        """Turn a limp servo. Raises ValueError while it holds."""
        if self.loaded:
            raise ValueError(f"servo {self.servo_id} holds its position: unload it first")
        self.rest_at(_within_reach(position))

    def __repr__(self) -> str:
        state = "missing" if self.missing else "off" if self.off else ""
        state = state or ("holding" if self.loaded else "limp")
        return f"Servo({self.servo_id}, {state}, position={self.position})"


def _within_reach(position: int) -> int:
    return min(max(position, LOWEST), HIGHEST)
