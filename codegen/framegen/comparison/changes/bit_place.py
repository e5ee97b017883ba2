"""Change: a named bit is another bit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import became, called, number_or_range

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.bits.twins:
        old, new = number_or_range(each.old.at), number_or_range(each.new.at)
        if old != new:
            # It may be written without the key `at`.
            text = f"{called(each.new_path)}: {became('bit', old, new)}"
            yield Change("bit-place", each.old_path, each.new_path, text)


RULE = ChangeRule(
    id="bit-place",
    title="A named bit is another bit",
    subject="value",
    why="One end sets a bit, and the other looks at another.",
    do="Give the new bit a name of its own.",
    at="messages.LampRead.fields",
    before="state: {type: u8, bits: {hot: 0}}",
    after="state: {type: u8, bits: {hot: 1}}",
    look=_look,
)
