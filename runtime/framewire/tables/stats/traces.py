"""What is drawn of a capture: the quantities that its messages carry, over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .trace import Trace

if TYPE_CHECKING:
    from ...frame.direction import Direction
    from ..events import Numbers, Seconds
    from .quantities import Quantity, Readings
    from .timeline import Moments

# So many channels or addresses of one quantity are kept.
_MOST_LINES = 64


class Traces:
    """All quantities of a capture over time.

    Without times, each byte is taken to come so many seconds behind the one before. What goes in
    the direction `received` is what the device says.
    """

    def __init__(self, seconds_per_byte: float, received: Direction) -> None:
        self.has_times = False
        self._seconds_per_byte = seconds_per_byte
        self._received = received
        self._found: dict[Quantity, dict[int, Trace]] = {}
        self.left_out: dict[Quantity, set[int]] = {}

    def add(
        self, quantity: Quantity, readings: Readings, offset: Numbers, moments: Moments | None
    ) -> None:
        """Take in values of a quantity, with the places or the moments of their frames."""
        if quantity.column.slot.role == "packed" or not len(readings.value):
            return
        self.has_times = self.has_times or moments is not None
        wire: Seconds = offset.astype(np.float64) * self._seconds_per_byte
        seconds = wire if moments is None else moments.seconds
        factor, beyond, _ = quantity.scale
        values = readings.value.astype(np.float64) * factor + beyond
        values[readings.absent] = np.nan
        known = self._found.setdefault(quantity, {})
        for key in np.unique(readings.key).tolist():
            if key not in known:
                if len(known) >= _MOST_LINES:
                    self.left_out.setdefault(quantity, set()).add(key)
                    continue
                known[key] = Trace()
            which = readings.key == key
            known[key].add(seconds[readings.frame[which]], values[which])

    def panels(self) -> list[tuple[Quantity, dict[int, Trace]]]:
        """Return what is worth a drawing, by quantity and key: the most often measured first.

        These are the readings of the device; what else has numbers is taken where it has none.
        """
        some = [
            (quantity, {key: traces[key] for key in sorted(traces) if traces[key].count})
            for quantity, traces in self._found.items()
        ]
        some = [(quantity, traces) for quantity, traces in some if traces]
        received = [each for each in some if each[0].layout.kind.DIRECTION is self._received]
        measured = [each for each in received if each[0].is_measured]
        sent = [each for each in some if each[0].is_measured]
        chosen = measured or sent or received or some
        return sorted(chosen, key=lambda each: (-_count(each[1]), each[0].place))


def _count(traces: dict[int, Trace]) -> int:
    return sum(each.count for each in traces.values())
