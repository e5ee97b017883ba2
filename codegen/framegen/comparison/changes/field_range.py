"""Change: a field may have other values."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.numbers:
        yield from changed("field-range", each, "range", each.old.range, each.new.range, "range")


RULE = ChangeRule(
    id="field-range",
    title="A field may have other values",
    subject="field",
    why="An end refuses a frame with a value outside the range that it knows.",
    do=(
        "Let ranges grow, and upgrade the receiver first. Where one must shrink, use `limits`: it "
        "holds for clients alone."
    ),
    at="messages.LampRead.fields",
    before="lamp_id: {type: u8, range: 0..200}",
    after="lamp_id: {type: u8, range: 0..100}",
    look=_look,
)
