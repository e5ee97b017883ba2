"""Change: a number has a name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("value-added", both.values, lambda each: str(each.what.value))


RULE = ChangeRule(
    id="value-added",
    title="A number has a name",
    subject="value",
    why=(
        "The library has a constant for it. An end of the old edition reads the number, and does "
        "not know what it means."
    ),
    do="Upgrade the receiver first, where the meaning is new and not only its name.",
    at="messages.LampRead.fields",
    before="time: {type: u16}",
    after="time: {type: u16, values: {at_once: {value: 0}}}",
    look=_look,
)
