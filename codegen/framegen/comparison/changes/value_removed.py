"""Change: a number has no name any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("value-removed", both.values, lambda each: str(each.what.value))


RULE = ChangeRule(
    id="value-removed",
    title="A number has no name any more",
    subject="value",
    why="The constant of the library is gone.",
    do="Keep the name, and say in `about` that it is not used any more.",
    at="messages.LampRead.fields",
    before="time: {type: u16, values: {at_once: {value: 0}}}",
    after="time: {type: u16}",
    look=_look,
)
