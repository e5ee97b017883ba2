"""Change: a message is answered by another, or by none."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        old, new = both.message(each.old.reply), each.new.reply
        yield from changed("reply-changed", each, "reply", old, new, "reply")


RULE = ChangeRule(
    id="reply-changed",
    title="A message is answered by another, or by none",
    subject="exchange",
    why=(
        "A client waits for the reply that it knows of. Where another comes, or none, it gives up "
        "after its timeout."
    ),
    do="Upgrade both ends at once, or add a request that has the new reply.",
    at="messages.LampRead",
    before="reply: LampState",
    after="",
    look=_look,
)
