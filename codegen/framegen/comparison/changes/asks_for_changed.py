"""Change: another field says how many items a reply holds."""

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
        old = both.field(str(each.old_path[1]), each.old.asks_for)
        yield from changed("asks-for-changed", each, "asks for", old, each.new.asks_for, "asks_for")


RULE = ChangeRule(
    id="asks-for-changed",
    title="Another field says how many items a reply holds",
    subject="exchange",
    why=(
        "A client ignores a reply with another number of items: one that it took may not come any "
        "more, or one of another request be taken again."
    ),
    do="Upgrade the device first if it sent other numbers of items.",
    at="messages",
    before=(
        "LevelsRead:\n"
        "  id: 20\n"
        "  reply: Levels\n"
        "  fields: {lamp_count: {type: u8, range: 1..20}}\n"
        "Levels:\n"
        "  id: 20\n"
        "  direction: lamp -> host\n"
        "  fields: {size: {type: u8}, levels: {type: u8, counted_by: size, count: 0..}}"
    ),
    after=(
        "LevelsRead:\n"
        "  id: 20\n"
        "  reply: Levels\n"
        "  asks_for: lamp_count\n"
        "  fields: {lamp_count: {type: u8, range: 1..20}}\n"
        "Levels:\n"
        "  id: 20\n"
        "  direction: lamp -> host\n"
        "  fields: {size: {type: u8}, levels: {type: u8, counted_by: size, count: 0..}}"
    ),
    look=_look,
)
