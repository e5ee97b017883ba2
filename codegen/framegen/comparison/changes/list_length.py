"""Change: something else says how long a list is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.fields.twins:
        name = str(each.old_path[1])
        for key, what in (("counted_by", "counted by"), ("sized_by", "sized by")):
            old, new = getattr(each.old, key), getattr(each.new, key)
            old = both.part(both.field(name, old))
            yield from changed("list-length", each, key, old, new, what)


RULE = ChangeRule(
    id="list-length",
    title="Something else says how long a list is",
    subject="field",
    why=(
        "An end that counts what the other measures, or the other way round, reads a list of "
        "another length, or refuses the frame."
    ),
    do="Add a message.",
    at="messages.LampsSet",
    before=("fields:\n  size: {type: u8}\n  levels: {type: u16, counted_by: size}"),
    after=("fields:\n  size: {type: u8}\n  levels: {type: u16, sized_by: size}"),
    look=_look,
)
