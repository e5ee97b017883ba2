"""Change: a message has another id."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.language.notation import Ids

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        old, new = each.old.id, each.new.id
        if old is not None and old.one is None:
            parts = [(str(both.part(name)), number) for name, number in old.by_part]
            old = Ids(None, tuple(parts))
        yield from changed("message-id", each, "id", old, new, "id")


RULE = ChangeRule(
    id="message-id",
    title="A message has another id",
    subject="message",
    why=(
        "An end knows a message by its id: under another it is unknown, or taken for another "
        "message."
    ),
    do="Add a message with the new id, and deprecate the old one.",
    at="messages.LampRead",
    before="id: 8",
    after="id: 18",
    look=_look,
)
