"""Change: a message is acknowledged by another report, or by none."""

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
        old, new = both.message(each.old.acknowledged), each.new.acknowledged
        yield from changed(
            "acknowledged-changed", each, "acknowledged", old, new, "acknowledged by"
        )


RULE = ChangeRule(
    id="acknowledged-changed",
    title="A message is acknowledged by another report, or by none",
    subject="exchange",
    why=(
        "The result of the method says whether the acknowledgement came in time: one that never "
        "comes takes a timeout."
    ),
    do="Upgrade the device first where it is new, and the client first where it is gone.",
    at="messages",
    before=(
        "LampState: {id: 8, direction: lamp -> host, fields: {lamp_id: {type: u8}}}\n"
        "LampOn:\n"
        "  id: 10\n"
        "  reports: [LampState]\n"
        "  fields: {lamp_id: {type: u8}}"
    ),
    after=(
        "LampState: {id: 8, direction: lamp -> host, fields: {lamp_id: {type: u8}}}\n"
        "LampOn:\n"
        "  id: 10\n"
        "  reports: [LampState]\n"
        "  acknowledged: LampState\n"
        "  fields: {lamp_id: {type: u8}}"
    ),
    look=_look,
)
