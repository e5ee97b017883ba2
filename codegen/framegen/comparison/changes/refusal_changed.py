"""Change: a message is refused by another, or by none."""

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
        old, new = both.message(each.old.refusal), each.new.refusal
        yield from changed("refusal-changed", each, "refusal", old, new, "refusal")


RULE = ChangeRule(
    id="refusal-changed",
    title="A message is refused by another, or by none",
    subject="exchange",
    why=(
        "A client that does not know the refusal waits for its reply until it times out. One that "
        "does raises it."
    ),
    do="Upgrade the client first: it can wait for a refusal that never comes.",
    at="",
    before=(
        "messages:\n"
        "  LampFailed: {id: 20, direction: lamp -> host}\n"
        "  LampRead:\n"
        "    id: 8\n"
        "    reply: LampState\n"
        "    fields: {lamp_id: {type: u8}}"
    ),
    after=(
        "messages:\n"
        "  LampFailed: {id: 20, direction: lamp -> host}\n"
        "  LampRead:\n"
        "    id: 8\n"
        "    reply: LampState\n"
        "    refusal: LampFailed\n"
        "    fields: {lamp_id: {type: u8}}"
    ),
    look=_look,
)
