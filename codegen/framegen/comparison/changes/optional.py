"""Change: a field may be absent, or not any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import switched

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.numbers:
        words = ("may not be absent any more", "may be absent now")
        yield from switched(
            "optional", each, "optional", each.old.optional, each.new.optional, words
        )


RULE = ChangeRule(
    id="optional",
    title="A field may be absent, or not any more",
    subject="field",
    why="An end that does not know that it may be absent refuses the shorter frame.",
    do="Upgrade the receiver first.",
    at="messages.LampRead.fields",
    before="colour: {type: u8}",
    after="colour: {type: u8, optional: true}",
    look=_look,
)
