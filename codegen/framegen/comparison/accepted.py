"""Accepted breaks: what the history of a spec says that it breaks on purpose, and why."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from framegen.comparison.effect import Effect
from framegen.comparison.explained import explain
from framegen.reading.yamltree import dotted

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from framegen.comparison.changes.change import Change
    from framegen.comparison.edition import Edition
    from framegen.comparison.pair import Pair
    from framegen.reading.yamltree import KeyPath


@dataclass(frozen=True, slots=True)
class Accepted:
    """A line of `breaks`: the version that has it, what may break, and the reason."""

    version: str
    path: str
    reason: str

    def covers(self, *paths: KeyPath | None) -> bool:
        """Tell whether one of these paths is the one that may break, or below it."""
        return any(path is not None and self._covers(dotted(path)) for path in paths)

    def _covers(self, path: str) -> bool:
        return path == self.path or path.startswith((f"{self.path}.", f"{self.path}["))


def accepted_breaks(pair: Pair) -> list[Accepted]:
    """Return what the new history accepts and the old one did not, or for another reason."""
    before = set(_lines(pair.old))
    return [each for each in _lines(pair.new) if each not in before]


def accept(effects: Iterable[Effect], pair: Pair, changes: Sequence[Change]) -> Iterator[Effect]:
    """Yield the effects, those that break on purpose with the reason.

    What breaks nothing by itself, such as a unit that was documented for the first time, breaks if
    the history says so.
    """
    lines = accepted_breaks(pair)
    met: set[Accepted] = set()
    for effect in effects:
        if not effect.breaks or not lines:
            yield effect
            continue
        reasons = [each for each in lines if each.covers(effect.old, effect.new)]
        reasons = reasons or _of_all_causes(effect, lines, changes)
        met.update(reasons)
        yield replace(effect, accepted="; ".join(dict.fromkeys(each.reason for each in reasons)))
    for line in lines:
        if line not in met:
            yield from _declared(line, changes)


def _lines(edition: Edition) -> Iterator[Accepted]:
    for release in edition.spec.history:
        for path, reason in release.breaks.items():
            yield Accepted(release.version, path, reason)


def _of_all_causes(
    effect: Effect, lines: Sequence[Accepted], changes: Sequence[Change]
) -> list[Accepted]:
    """Return what accepts every change that is behind an effect; nothing if one is left."""
    found: list[Accepted] = []
    for change in explain(effect, changes):
        reasons = [each for each in lines if each.covers(change.old, change.new)]
        if not reasons:
            return []
        found += reasons
    return found


def _declared(line: Accepted, changes: Sequence[Change]) -> Iterator[Effect]:
    """Yield an effect for each change that breaks because the author says so."""
    for change in changes:
        if line.covers(change.old, change.new):
            text = f"{change.text}, which is another meaning"
            yield Effect("wire", "declared", change.old, change.new, text, accepted=line.reason)
