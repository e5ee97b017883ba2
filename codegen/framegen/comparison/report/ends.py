"""Who talks to whom, each with its edition: `old host with new controller`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.comparison.effect import Effect
    from framegen.comparison.pair import Pair


@dataclass(frozen=True, slots=True)
class Ends:
    """Two ends of a line; the first has the old edition or the new one, and the second the other.

    They have the names of the new edition, in its order.
    """

    first: str
    second: str
    old_first: bool

    def __str__(self) -> str:
        first, second = ("old", "new") if self.old_first else ("new", "old")
        return f"{first} {self.first} with {second} {self.second}"


def ends_of(pair: Pair, effect: Effect) -> Ends | None:
    """Return between whom an effect is; None for one on programs."""
    parts = [part.partition(" ") for part in effect.ends.split(", ")]
    if len(parts) != 2:
        return None
    (which, _, one), (_, _, other) = parts
    return _ordered(pair, which == "old", one, other)


def all_ends(pair: Pair) -> list[Ends]:
    """Return all that talk to each other in either edition, each two of them in both ways."""
    ways = (*pair.new.model.directions, *pair.old.model.directions)
    found = (
        _ordered(pair, old_first, way.sender, way.receiver)
        for way in ways
        for old_first in (True, False)
    )
    return _sorted(pair, dict.fromkeys(found))


def upgrade_order(broken: Iterable[Ends]) -> str:
    """Say which end is upgraded first, where these do not understand each other."""
    ends = [*broken]
    twice = len({(each.first, each.second) for each in ends}) < len(ends)
    # An end that asks in one edition and answers in the other breaks with itself.
    if twice or any(each.first == each.second for each in ends):
        return "both ends at once: each breaks with the old edition of the other"
    # What an old end breaks with must not be there before that is upgraded.
    orders = {
        (each.first, each.second) if each.old_first else (each.second, each.first) for each in ends
    }
    return ", and ".join(f"every {early} before any {late}" for early, late in sorted(orders))


def _ordered(pair: Pair, old_first: bool, one: str, other: str) -> Ends:
    order = _order(pair)
    first, second = (pair.ends.get(name, name) for name in (one, other))
    if order.index(first) <= order.index(second):
        return Ends(first, second, old_first)
    return Ends(second, first, not old_first)


def _sorted(pair: Pair, ends: Iterable[Ends]) -> list[Ends]:
    order = _order(pair)
    return sorted(
        ends,
        key=lambda each: (order.index(each.first), order.index(each.second), not each.old_first),
    )


def _order(pair: Pair) -> list[str]:
    """Return the ends of both editions; those that are gone come last."""
    return [*dict.fromkeys([*pair.new.spec.endpoints, *pair.old.spec.endpoints])]
