"""Change: a message is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("message-removed", both.messages)


RULE = ChangeRule(
    id="message-removed",
    title="A message is gone",
    subject="message",
    why=(
        "Ends of the old edition go on sending it, and nobody understands it. Under its id, they "
        "would take another message for it."
    ),
    do=(
        "Before it goes, it is `deprecated` for a while; once it is gone, its id and its name "
        "stay in `reserved`."
    ),
    at="messages",
    before="LampBlink: {id: 9, fields: {lamp_id: {type: u8}}}",
    after="",
    look=_look,
)
