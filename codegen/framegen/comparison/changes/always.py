"""Change: a field has another value always, or another than always."""

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
        old, new = each.old.always, each.new.always
        yield from changed("always", each, "always", old, new, "always")


RULE = ChangeRule(
    id="always",
    title="A field has another value always, or another than always",
    subject="field",
    why="A frame with another value than it always has is refused. It is no argument.",
    do="Add a message, as the value tells one layout from another.",
    at="messages.LampRead.fields",
    before="layout: {type: u8, always: 1}",
    after="layout: {type: u8, always: 2}",
    look=_look,
)
