"""Change: there is a new message."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("message-added", both.messages)


RULE = ChangeRule(
    id="message-added",
    title="There is a new message",
    subject="message",
    why="Ends of the old edition do not know it, and refuse it.",
    do="Upgrade the end that receives it first.",
    at="messages",
    before="",
    after="LampBlink: {id: 9, fields: {lamp_id: {type: u8}}}",
    look=_look,
)
