"""Change: a named value has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import renamed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from renamed("value-renamed", both.values)


RULE = ChangeRule(
    id="value-renamed",
    title="A named value has another name",
    subject="value",
    why="The constant of the library has another name.",
    do="Change it together with another break of programs. `was` says that it is the same.",
    at="messages.LampRead.fields",
    before="time: {type: u16, values: {at_once: {value: 0}}}",
    after="time: {type: u16, values: {now: {value: 0, was: at_once}}}",
    look=_look,
)
