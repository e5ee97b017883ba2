"""Change: a value says that there is nothing to tell of, or not any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import switched

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.values.twins:
        words = ("does not mean that there is nothing any more", "means that there is nothing now")
        yield from switched("absent-value", each, "absent", each.old.absent, each.new.absent, words)


RULE = ChangeRule(
    id="absent-value",
    title="A value says that there is nothing to tell of, or not any more",
    subject="program",
    why="The library has the property `absent`, and does not send the value as if it were one.",
    do="Change it together with another break of programs.",
    at="messages.LampRead.fields",
    before="time: {type: u16, values: {none: {value: 0xFFFF}}}",
    after="time: {type: u16, values: {none: {value: 0xFFFF, absent: true}}}",
    look=_look,
)
