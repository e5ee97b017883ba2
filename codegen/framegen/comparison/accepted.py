"""Accepted breaks: what the history of a spec says that it breaks on purpose, and why."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from framegen.checks.breaks import whats_wrong
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
    return [each for each in _new_lines(pair) if whats_wrong(each.path) is None]


def ignored_breaks(pair: Pair) -> list[tuple[Accepted, str]]:
    """Return what the new history accepts in vain, as no break is at such a path, and why not."""
    found = ((each, whats_wrong(each.path)) for each in _new_lines(pair))
    return [(each, str(wrong)) for each, wrong in found if wrong is not None]


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
        reasons = _reasons(effect, pair, lines, changes)
        met.update(reasons)
        yield replace(effect, accepted="; ".join(dict.fromkeys(each.reason for each in reasons)))
    for line in lines:
        if line not in met:
            yield from _declared(line, changes)


def _new_lines(pair: Pair) -> list[Accepted]:
    before = set(_lines(pair.old))
    return [each for each in _lines(pair.new) if each not in before]


def _lines(edition: Edition) -> Iterator[Accepted]:
    for release in edition.spec.history:
        for path, reason in release.breaks.items():
            yield Accepted(release.version, path, reason)


def places(effect: Effect) -> list[KeyPath]:
    """Return the paths that are accepted for an effect: its own.

    Where a message that is gone is read as others, it is those that bring this about.
    """
    others = _read_instead(effect)
    return [("messages", each) for each in others] if others else [effect.path]


def _read_instead(effect: Effect) -> tuple[str, ...]:
    """Return what the new edition reads of a message that is gone; nothing where it refuses it."""
    if effect.new is not None or effect.witness is None:
        return ()
    return effect.witness.read_as


def _is_guess(effect: Effect, pair: Pair) -> bool:
    """Tell whether frames of one message are read as another that may be the same."""
    if effect.old is None or effect.new is None or effect.axis == "programs":
        return False
    return effect.old[:1] == ("messages",) and effect.old[1] in pair.messages.guessed


def _reasons(
    effect: Effect, pair: Pair, lines: Sequence[Accepted], changes: Sequence[Change]
) -> list[Accepted]:
    """Return what accepts an effect; that a message may be gone gives its id to no other."""
    others = _read_instead(effect)
    if not others and _is_guess(effect, pair):
        return [each for each in lines if each.covers(effect.new)]
    if not others:
        own = [each for each in lines if each.covers(effect.old, effect.new)]
        return own or _of_all_causes(effect, lines, changes)
    found = [[each for each in lines if each.covers(("messages", name))] for name in others]
    return [each for reasons in found for each in reasons] if all(found) else []


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
