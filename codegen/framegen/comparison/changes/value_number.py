"""Change: a named value is another number."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.values.twins:
        yield from changed("value-number", each, "value", each.old.value, each.new.value)


RULE = ChangeRule(
    id="value-number",
    title="A named value is another number",
    subject="value",
    why="One end says a name, and the other understands a number, or another name.",
    do="Give the new number a name of its own.",
    at="messages.LampRead.fields",
    before="time: {type: u16, values: {at_once: {value: 0}}}",
    after="time: {type: u16, values: {at_once: {value: 1}}}",
    look=_look,
)
