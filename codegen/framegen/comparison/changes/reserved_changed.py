"""Change: a reserved id or name says something else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.language.values import Direction

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.reserved.twins:
        way = each.old.direction
        if way is not None:
            ends = both.pair.ends
            way = Direction(ends.get(way.sender, way.sender), ends.get(way.receiver, way.receiver))
        yield from changed("reserved-changed", each, "id", each.old.id, each.new.id, "id")
        yield from changed("reserved-changed", each, "name", each.old.name, each.new.name, "name")
        yield from changed(
            "reserved-changed", each, "direction", way, each.new.direction, "direction"
        )


RULE = ChangeRule(
    id="reserved-changed",
    title="A reserved id or name says something else",
    subject="message",
    why=(
        "What is reserved is never given to another message, so that nobody takes one for the "
        "other."
    ),
    do="Keep what was reserved.",
    at="",
    before=("reserved:\n  - {id: 30, why: LampDim had it.}"),
    after=("reserved:\n  - {id: 31, why: LampDim had it.}"),
    look=_look,
)
