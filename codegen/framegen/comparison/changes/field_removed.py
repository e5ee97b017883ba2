"""Change: a field of a message is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed
from framegen.comparison.changes.wording import described

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("field-removed", both.fields, described)


RULE = ChangeRule(
    id="field-removed",
    title="A field of a message is gone",
    subject="field",
    why="Frames are shorter: an end refuses those of the other edition.",
    do=(
        "Keep the place of a field that goes: `reserved: 0` has it written as zero and read as "
        "anything."
    ),
    at="messages.LampRead.fields",
    before="colour: {type: u8}",
    after="",
    look=_look,
)
