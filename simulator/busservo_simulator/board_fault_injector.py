"""The fault injector of a board's line: faults that only what a board sends can have."""

from __future__ import annotations

from typing import TYPE_CHECKING

from busservo import (
    ActionGroupCompleted,
    ActionGroupStarted,
    ActionGroupStopped,
    ServoPosition,
    ServoPositions,
)
from busservo._library import LIBRARY
from framewire.simulator.fault_injector import FaultInjector

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framewire.simulator.fault_injector import Report

    from busservo_simulator.faults import Faults

# Where the count of servos stands in the reply that has one: behind header, length and command.
COUNT_AT = 4


class BoardFaultInjector(FaultInjector):
    """One run of faults, repeatable by their seed."""

    def __init__(self, faults: Faults) -> None:
        super().__init__(faults, LIBRARY)
        self._kinds = faults

    def reports(self, report: Report) -> Iterator[Report]:
        """Yield the reports that are sent in place of `report`."""
        if self._happens(self._kinds.unsolicited):
            yield self._unsolicited()
        yield from super().reports(report)

    def changed(self, report: Report) -> Report:
        """Return the report without some of its servos, or with some that are off."""
        if isinstance(report, ServoPositions) and (self._kinds.fewer or self._kinds.absent):
            return self._thinned(report)
        return report

    def frame(self, report: Report) -> bytes:
        """Return the frame of a report, its count of servos off by one if that fault happens."""
        frame = report.encode()
        if not (isinstance(report, ServoPositions) and self._happens(self._kinds.wrong_count)):
            return frame
        count = (frame[COUNT_AT] + self._random.choice((-1, 1))) % 256
        return frame[:COUNT_AT] + bytes([count]) + frame[COUNT_AT + 1 :]

    def _unsolicited(self) -> Report:
        group = self._random.randrange(256)
        reports: list[Report] = [
            ActionGroupStarted(group, 1),
            ActionGroupStopped(),
            ActionGroupCompleted(group, 1),
        ]
        return self._random.choice(reports)

    def _thinned(self, report: ServoPositions) -> ServoPositions:
        kept: list[tuple[int, int]] = []
        for servo_id, position in report.positions:
            if self._happens(self._kinds.fewer):
                continue
            absent = self._happens(self._kinds.absent)
            kept.append((servo_id, ServoPosition.POSITION_ABSENT if absent else position))
        return ServoPositions(kept)
