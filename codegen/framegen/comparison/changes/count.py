"""Change: a list may have another number of elements."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.changes.wording import number_or_range

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.fields.twins:
        old, new = number_or_range(each.old.count), number_or_range(each.new.count)
        yield from changed("count", each, "count", old, new, "count")


RULE = ChangeRule(
    id="count",
    title="A list may have another number of elements",
    subject="field",
    why="An end refuses a list that is longer or shorter than it may be.",
    do="Let bounds grow, and upgrade the receiver first.",
    at="messages.LampsSet",
    before=(
        "fields:\n"
        "  lamp_count: {type: u8}\n"
        "  levels: {type: u8, counted_by: lamp_count, count: 1..8}"
    ),
    after=(
        "fields:\n"
        "  lamp_count: {type: u8}\n"
        "  levels: {type: u8, counted_by: lamp_count, count: 1..4}"
    ),
    look=_look,
)
