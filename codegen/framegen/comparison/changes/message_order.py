"""Change: the messages are listed in another order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import moved

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from moved("message-order", both.messages)


RULE = ChangeRule(
    id="message-order",
    title="The messages are listed in another order",
    subject="program",
    why=(
        "Where a frame fits two messages, the first is preferred. Pages and constants follow this "
        "order too."
    ),
    do="Nothing, unless two messages have the same id and the same length.",
    at="messages",
    before=(
        "LampRead: {id: 8, fields: {lamp_id: {type: u8}}}\n"
        "LampOff: {id: 9, fields: {lamp_id: {type: u8}}}"
    ),
    after=(
        "LampOff: {id: 9, fields: {lamp_id: {type: u8}}}\n"
        "LampRead: {id: 8, fields: {lamp_id: {type: u8}}}"
    ),
    look=_look,
)
