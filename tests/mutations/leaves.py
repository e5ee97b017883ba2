"""Specs with one leaf changed, and changes turned round."""

from collections.abc import Iterable

from framegen.comparison.changes import changes
from framegen.comparison.changes.change import Change
from framegen.comparison.edition import Edition
from framegen.comparison.pair import Pair
from pydantic import ValidationError

from tests.factories import Data, Steps
from tests.mutations.edits import edition
from tests.mutations.kinds import readable
from tests.mutations.places import leaves, with_


def others(data: Data, path: Steps, value: object, old: Edition) -> Edition | None:
    """Return an edition with another value at a place; None where no other can be read."""
    for other in readable(value):
        try:
            new = edition(with_(data, *path, other), checked=False)
        except (ValidationError, AssertionError, LookupError, StopIteration, ArithmeticError):
            continue
        if new.spec != old.spec:
            return new
    return None


def told_at_their_places(data: Data, each: int, first: int = 0) -> int:
    """Change one of so many leaves; each is told there, or above. Return how many there are."""
    old, seen = edition(data), 0
    for path, value in [*leaves(data)][first % each :: each]:
        new = others(data, path, value, old)
        if new is None:
            continue
        seen += 1
        told = changes(Pair(old, new))
        places = [place for change in told for place in (change.old, change.new) if place]
        # What is written in short is told at the key that it stands for.
        assert any(path[: len(each)] == each or each[: len(path)] == path for each in places), path
        assert mirrored(told) == turned(changes(Pair(new, old)))
    return seen


def mirrored(told: Iterable[Change]) -> list[tuple[str, str, str]]:
    """Return changes as they are the other way round: what is new is gone, and old is new."""
    return sorted((_opposite(each.rule), repr(each.new), repr(each.old)) for each in told)


def turned(told: Iterable[Change]) -> list[tuple[str, str, str]]:
    return sorted((each.rule, repr(each.old), repr(each.new)) for each in told)


def _opposite(rule: str) -> str:
    for one, other in (("-added", "-removed"), ("-removed", "-added")):
        if rule.endswith(one):
            return rule.removesuffix(one) + other
    return rule
