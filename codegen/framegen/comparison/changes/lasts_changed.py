"""Change: another field says how long a message takes effect."""

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
        old = both.field(str(each.old_path[1]), each.old.lasts)
        yield from changed("lasts-changed", each, "lasts", old, each.new.lasts, "lasts")


RULE = ChangeRule(
    id="lasts-changed",
    title="Another field says how long a message takes effect",
    subject="exchange",
    why=(
        "The result of the method can wait until it is over: without it, programs that do so fail."
    ),
    do="Keep it while programs wait.",
    at="messages",
    before="LampOn: {id: 10, fields: {time_ms: {type: u16, unit: ms}}}",
    after="LampOn: {id: 10, lasts: time_ms, fields: {time_ms: {type: u16, unit: ms}}}",
    look=_look,
)
