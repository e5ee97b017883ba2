"""Verdicts: on each axis and for each two ends, how much breaks, and what exit status that has."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from framegen.comparison.effect import Axis, Effect
    from framegen.comparison.report.ends import Ends

Standing: TypeAlias = Literal["breaks", "uncertain", "accepted", "adds"]
STANDINGS: tuple[Standing, ...] = ("breaks", "uncertain", "accepted", "adds")
# What users read of each.
STANDING_WORDS: dict[Standing, str] = {
    "breaks": "breaks",
    "uncertain": "uncertain",
    "accepted": "on purpose",
    "adds": "new",
}
AXES: tuple[Axis, ...] = ("wire", "conversation", "programs")

FAILURES = (*AXES, "uncertain", "version", "never")
USUAL_FAILURES = frozenset([*AXES, "uncertain"])
# The exit statuses beside those of every command.
BREAKS, UNCERTAIN, NO_VERSION = 1, 3, 4


def standing(effect: Effect) -> Standing:
    """Return how an effect counts."""
    if not effect.breaks:
        return "adds"
    if effect.accepted:
        return "accepted"
    return "breaks" if effect.certain else "uncertain"


@dataclass(frozen=True, slots=True)
class Verdict:
    """The effects on one axis, between two ends; `ends` is None for programs."""

    axis: Axis
    ends: Ends | None
    effects: Sequence[Effect]

    @property
    def counts(self) -> dict[Standing, Counter[str]]:
        """How many effects there are of each standing, by outcome, the most first."""
        found: dict[Standing, Counter[str]] = {each: Counter() for each in STANDINGS}
        for effect in self.effects:
            found[standing(effect)][effect.outcome] += 1
        return {each: counted for each, counted in found.items() if counted}

    @property
    def breaks(self) -> bool:
        """Whether anything breaks for certain, be it on purpose."""
        return any(effect.breaks and effect.certain for effect in self.effects)

    def __str__(self) -> str:
        said = [_said(each, counted) for each, counted in self.counts.items()]
        return "; ".join(said) or "works as before"


def exit_status(effects: Iterable[Effect], finding: str | None, fail_on: frozenset[str]) -> int:
    """Return the exit status, of a comparison or of several."""
    found = [effect for effect in effects if not effect.accepted]
    if any(standing(effect) == "breaks" and effect.axis in fail_on for effect in found):
        return BREAKS
    if "uncertain" in fail_on and any(standing(effect) == "uncertain" for effect in found):
        return UNCERTAIN
    return NO_VERSION if finding and "version" in fail_on else 0


def _said(each: Standing, counted: Counter[str]) -> str:
    if each == "breaks":
        outcomes = ", ".join(f"{number} {outcome}" for outcome, number in counted.most_common())
        return f"breaks: {outcomes}"
    what = {"uncertain": "uncertain", "accepted": "breaks on purpose", "adds": "new"}[each]
    return f"{what}: {counted.total()}"
