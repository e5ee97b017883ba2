"""Change: a field is reserved, or written otherwise."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.numbers:
        old, new = each.old.reserved, each.new.reserved
        yield from changed("reserved-field", each, "reserved", old, new, "reserved as")


RULE = ChangeRule(
    id="reserved-field",
    title="A field is reserved, or written otherwise",
    subject="field",
    why="What is reserved is read as anything: it is no argument, and what it said is lost.",
    do=(
        "Reserve a field whose meaning is gone, and give a reserved one a meaning only where zero "
        "means what it meant."
    ),
    at="messages.LampRead.fields",
    before="colour: {type: u8}",
    after="colour: {type: u8, reserved: 0}",
    look=_look,
)
