"""The battery: empties slowly, and sags while servos are at work."""

from __future__ import annotations

EMPTY_MV = 6000
IDLE_MV_PER_HOUR = 60.0
BUSY_MV_PER_HOUR = 300.0
SAG_MV = 25.0


class Battery:
    """Two lithium cells. What it has lost and what it lends just now make its voltage."""

    def __init__(self, full_mv: int = 7500) -> None:
        self.full_mv = full_mv
        self._drawn_mv = 0.0
        self._busy = 0

    def drain(self, seconds: float, busy_seconds: float, busy_now: int) -> None:
        """Takes what that time cost: `busy_seconds` are summed over all servos."""
        self._drawn_mv += (seconds * IDLE_MV_PER_HOUR + busy_seconds * BUSY_MV_PER_HOUR) / 3600
        self._busy = busy_now

    @property
    def voltage_mv(self) -> int:
        """The voltage at the terminals, in mV."""
        return max(EMPTY_MV, round(self.full_mv - self._drawn_mv - self._busy * SAG_MV))
