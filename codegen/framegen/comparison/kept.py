"""Kept editions: what those before the one that is compared misread, and it does not.

Boards and programs of every released edition are in use. What an older one and the newest one
understand alike needs no second trial: only messages are tried that are in either of two editions
as they are in no other.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from framegen.comparison.effect import Effect
from framegen.comparison.pair import Pair
from framegen.comparison.reused import reuse_effects
from framegen.comparison.wire import trials_of
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.comparison.edition import Edition
    from framegen.comparison.effect import Outcome, Which, Witness
    from framegen.comparison.partners import Listed
    from framegen.comparison.wire import Trial

# What the frames of all messages depend on.
_SHARED = ("endpoints", "byte_order", "frame", "frames")
# What is read, but as something else. That a frame is refused, the newest edition shows as well.
_WRONG: tuple[Outcome, ...] = ("uncertain", "misread")
_NAME_TAKEN = "programs in use may still know another message of that name"


@dataclass
class Found:
    """What kept editions show; `unread` are those that cannot be read, and why."""

    effects: list[Effect] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)


def look_at_kept(pair: Pair, kept: Iterable[Listed]) -> Found:
    """Hold the new edition against kept ones, of which the newest comes first.

    What several show is one effect, of all of them. Where no message changed, none is read.
    """
    found = Found()
    if _facts(pair.old) == _facts(pair.new):
        return found
    effects: dict[object, Effect] = {}
    for listed in kept:
        try:
            shown = [*_Kept(listed.edition, pair).effects()]
        except Unusable as error:
            found.unread.append(f"{listed.path}: {error}")
            continue
        except Exception:
            if not listed.edition.compiled.tolerated:
                raise
            # What a rule is there to prevent may have any consequence.
            found.unread.append(f"{listed.path} contradicts itself too much")
            continue
        for each in shown:
            key = each.axis, each.outcome, each.new, each.ends, each.text
            first = effects.get(key, each)
            editions = dict.fromkeys((*first.editions, *each.editions))
            effects[key] = replace(first, editions=(*editions,))
    found.effects = [*effects.values()]
    return found


class _Kept:
    """A kept edition, beside the two that are compared."""

    def __init__(self, edition: Edition, pair: Pair) -> None:
        self.pair = pair
        self.before = Pair(edition, pair.old)
        self.after = Pair(edition, pair.new)

    def effects(self) -> Iterator[Effect]:
        """Yield what is misread, and the ids and names that mean another message now."""
        version = self.after.old.version
        found = [*self._misread("old"), *self._misread("new"), *self._names(), *self._reserved()]
        yield from (replace(each, old=None, editions=(version,)) for each in found)

    def _misread(self, sender: Which) -> Iterator[Effect]:
        """Yield what is read as something else, where that is not known from other editions."""
        same = _same(self.after.edition(sender), self.pair.old)
        for trial in trials_of(self.after, sender):
            if trial.message.name not in same:
                found = _worst(trial)
                if found is not None and not self._is_known(sender, found):
                    yield self._effect(trial, found)

    def _is_known(self, sender: Which, found: Witness) -> bool:
        """Tell whether the edition that is compared misreads that, or is misread, as well."""
        name = found.message
        if sender == "old":
            again = (self.before, name), (self.pair, self.before.messages.to_new.get(name))
        else:
            again = (self.pair, name), (self.before, self.pair.messages.to_old.get(name))
        known = (
            _worst(trial)
            for pair, there in again
            for trial in trials_of(pair, sender)
            if trial.message.name == there
        )
        return any(each is not None and _is_as_bad(each, found) for each in known)

    def _effect(self, trial: Trial, found: Witness) -> Effect:
        ours, pairing = trial.message.name, self.after.messages
        theirs = next(iter(found.read_as), trial.other and trial.other.name) or ours
        taken, former = (theirs, ours) if trial.sender == "old" else (ours, theirs)
        remedy = ""
        if found.read_as:
            remedy = f"Give {taken} another id, and reserve that of {former}."
        elif former in pairing.guessed:
            remedy = (
                f"If it is the same, write `was: {former}` below `messages.{taken}`; if it is not, "
                f"give it another id, and reserve that of {former}."
            )
        way = trial.message.direction
        other: Which = "new" if trial.sender == "old" else "old"
        return Effect(
            axis="wire",
            outcome=found.outcome,
            old=None,
            new=("messages", taken),
            text=f"{ours} {found.reading}",
            ends=f"{trial.sender} {way.sender}, {other} {way.receiver}",
            certain=found.outcome != "uncertain",
            witness=found,
            remedy=remedy,
        )

    def _names(self) -> Iterator[Effect]:
        """Yield the names that come back for a message with another id."""
        there, between, here = (
            each.spec.messages for each in (self.after.old, self.pair.old, self.pair.new)
        )
        for name in here:
            if name in there and name not in between and there[name].id != here[name].id:
                yield Effect(
                    axis="programs",
                    outcome="uncertain",
                    old=None,
                    new=("messages", name),
                    text=f"{name}: {_NAME_TAKEN}",
                    certain=False,
                    remedy=f"Give it another name, and reserve `{name}`.",
                )

    def _reserved(self) -> Iterator[Effect]:
        """Yield what takes ids and names that this edition reserves, and a later one set free."""
        known = {
            (each.axis, each.new)
            for pair in (self.before, self.pair)
            for each in reuse_effects(pair)
        }
        for each in reuse_effects(self.after):
            if (each.axis, each.new) not in known:
                yield each


def _worst(trial: Trial) -> Witness | None:
    """Return the worst frame that is read as something else; None where none is."""
    return trial.found_in(
        (witness, breaks)
        for witness, breaks in trial.frames()
        if breaks and witness.outcome in _WRONG
    ).breaking


def _is_as_bad(known: Witness, found: Witness) -> bool:
    worse = _WRONG.index(found.outcome) > _WRONG.index(known.outcome)
    return not worse and known.read_as == found.read_as


def _facts(edition: Edition) -> dict[str, Any]:
    """Return what the frames of an edition depend on, as its author wrote it."""
    data = edition.compiled.tree.data
    return {key: data.get(key) for key in (*_SHARED, "messages")}


def _same(one: Edition, other: Edition) -> frozenset[str]:
    """Return the names of the messages that two editions have word by word."""
    ours, theirs = _facts(one), _facts(other)
    if any(ours[key] != theirs[key] for key in _SHARED):
        return frozenset()
    messages = theirs["messages"]
    return frozenset(name for name, each in ours["messages"].items() if messages.get(name) == each)
