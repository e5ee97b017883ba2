"""Specs with one leaf changed, and changes turned round."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.comparison.changes import changes
from framegen.comparison.pair import Pair
from pydantic import ValidationError

from tests.mutations.edits import edition, with_

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.comparison.changes.change import Change
    from framegen.comparison.edition import Edition

    from tests.factories import Data, Steps

# What a spec can hold in the place of a text, somewhere.
_TEXTS = ("host -> controller", "55 55 02 07", "0..9", "u8", "u16", "odd", "big", "little", "2 V")


def leaves(value: Any, path: Steps = ()) -> Iterator[tuple[Steps, Any]]:
    """Yield every text and number with the steps to it."""
    if isinstance(value, dict | list):
        for key, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(item, (*path, key))
    else:
        yield path, value


def others(data: Data, path: Steps, value: Any, old: Edition) -> Edition | None:
    """Return an edition with another value at a place; None where no other can be read."""
    for other in _others(value):
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


def _others(value: Any) -> list[Any]:
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1]
    return [f"{value} too", f"{value}2", *_TEXTS, "firmware", "document"]


def mirrored(told: Iterable[Change]) -> list[tuple[str, str, str]]:
    """Return changes as they are the other way round: what is new is gone, and old is new."""
    return sorted((_opposite(each.rule), repr(each.new), repr(each.old)) for each in told)


def turned(told: Iterable[Change]) -> list[tuple[str, str, str]]:
    """Return changes as they are."""
    return sorted((each.rule, repr(each.old), repr(each.new)) for each in told)


def _opposite(rule: str) -> str:
    for one, other in (("-added", "-removed"), ("-removed", "-added")):
        if rule.endswith(one):
            return rule.removesuffix(one) + other
    return rule
