"""Change: a reply repeats other fields of its request."""

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
        name, reply = str(each.old_path[1]), each.old.reply or ""
        old = [
            (both.field(name, one), both.field(reply, other))
            for one, other in each.old.echoed.items()
        ]
        before, after = (
            ", ".join(f"{one} as {other}" for one, other in pairs)
            for pairs in (old, each.new.echoed.items())
        )
        yield from changed("echoed-changed", each, "echoed", before, after, "echoed")


RULE = ChangeRule(
    id="echoed-changed",
    title="A reply repeats other fields of its request",
    subject="exchange",
    why=(
        "It is how a client tells the reply to its request from others: with other fields it "
        "ignores the reply, or takes a wrong one."
    ),
    do="Upgrade the device first if it repeats more than it did; the client first if less.",
    at="messages",
    before=(
        "LampRead:\n"
        "  id: 8\n"
        "  reply: LampState\n"
        "  fields: {lamp_id: {type: u8}}\n"
        "LampState: {id: 8, direction: lamp -> host, fields: {lamp_id: {type: u8}}}"
    ),
    after=(
        "LampRead:\n"
        "  id: 8\n"
        "  reply: LampState\n"
        "  echoed: {lamp_id: lamp_id}\n"
        "  fields: {lamp_id: {type: u8}}\n"
        "LampState: {id: 8, direction: lamp -> host, fields: {lamp_id: {type: u8}}}"
    ),
    look=_look,
)
