"""The battery: empties slowly, and sags while servos are at work."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

# No battery falls below this, but one that began below it, which stays where it began.
EMPTY_MV = 6000
IDLE_MV_PER_HOUR = 60.0
BUSY_MV_PER_HOUR = 300.0
SAG_MV = 25.0


class Battery:
    """Two lithium cells. `travelling` returns how many servos are at work just now."""

    def __init__(self, full_mv: int, travelling: Callable[[], int]) -> None:
        self.full_mv = full_mv
        self._travelling = travelling
        self._drawn_mv = 0.0

    def drain(self, seconds: float, busy_seconds: float) -> None:
        """Subtract the charge for that time; `busy_seconds` are those of all servos together."""
        self._drawn_mv += (seconds * IDLE_MV_PER_HOUR + busy_seconds * BUSY_MV_PER_HOUR) / 3600

    @property
    def voltage_mv(self) -> int:
        """The voltage at the terminals, in mV."""
        now = self.full_mv - self._drawn_mv - self._travelling() * SAG_MV
        return min(max(round(now), min(EMPTY_MV, self.full_mv)), 65535)
