"""A running action group: the step it is at, and how many runs are left."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from busservo_simulator.action_group import ActionGroup, Step


class Performance:
    """One call of an action group. `times` 0 goes on until it is stopped."""

    def __init__(self, number: int, group: ActionGroup, times: int, moment: float) -> None:
        self.number = number
        self.times = times
        self.due = moment
        self._group = group
        self._step = 0
        self._runs = 0

    @property
    def ended(self) -> bool:
        """Whether the last step of the last run is over."""
        return self.times > 0 and self._runs == self.times

    def next_step(self, percent: int) -> Step:
        """Take the step that is due; the one behind it is due when this one is over."""
        step = self._group.steps[self._step]
        self.due += step.seconds(percent)
        self._step += 1
        if self._step == len(self._group.steps):
            self._step = 0
            self._runs += 1
        return step
