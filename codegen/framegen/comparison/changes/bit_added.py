"""Change: a bit has a name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added
from framegen.comparison.changes.wording import number_or_range

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("bit-added", both.bits, lambda each: number_or_range(each.what.at))


RULE = ChangeRule(
    id="bit-added",
    title="A bit has a name",
    subject="value",
    why="The library has a property for it. An end of the old edition does not look at it.",
    do="Nothing, as long as zero means what it meant.",
    at="messages.LampRead.fields",
    before="state: {type: u8, bits: {hot: 0}}",
    after="state: {type: u8, bits: {hot: 0, broken: 1}}",
    look=_look,
)
