"""Change: a bit has no name any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed
from framegen.comparison.changes.wording import number_or_range

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("bit-removed", both.bits, lambda each: number_or_range(each.what.at))


RULE = ChangeRule(
    id="bit-removed",
    title="A bit has no name any more",
    subject="value",
    why="The property of the library is gone.",
    do="Keep the name, and say in `about` that it is not used any more.",
    at="messages.LampRead.fields",
    before="state: {type: u8, bits: {hot: 0, broken: 1}}",
    after="state: {type: u8, bits: {hot: 0}}",
    look=_look,
)
