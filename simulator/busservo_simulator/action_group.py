"""Action groups as they are stored on the board: poses, and how long each takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

SHORTEST_STEP = 0.001


@dataclass(frozen=True, slots=True)
class Step:
    """One pose of an action group: after `time_ms`, these servos are at these positions."""

    time_ms: int
    targets: Mapping[int, int]

    def seconds(self, percent: int) -> float:
        """Return how long it takes at `percent` of the recorded speed."""
        return max(SHORTEST_STEP, self.time_ms / 10 / percent)


@dataclass(frozen=True, slots=True)
class ActionGroup:
    """Steps, run one after the other."""

    steps: tuple[Step, ...]

    def __init__(self, steps: tuple[Step, ...] | list[Step]) -> None:
        if not steps:
            raise ValueError("an action group needs a step")
        object.__setattr__(self, "steps", tuple(steps))


def stored_groups() -> dict[int, ActionGroup]:
    """Return the groups of a new board: 1 nods, 2 waves, 8 stands up."""
    return {
        1: ActionGroup([Step(200, {3: 600}), Step(200, {3: 400}), Step(200, {3: 500})]),
        2: ActionGroup([Step(300, {1: 300, 6: 700}), Step(300, {1: 700, 6: 300})]),
        8: ActionGroup([Step(400, {2: 500, 3: 500, 4: 500}), Step(400, {5: 500, 6: 500})]),
    }
