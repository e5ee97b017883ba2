"""Change: a message has another field."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added
from framegen.comparison.changes.wording import described

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("field-added", both.fields, described)


RULE = ChangeRule(
    id="field-added",
    title="A message has another field",
    subject="field",
    why=(
        "Frames are longer: an old end refuses those that have it. A new end refuses those that "
        "lack it, unless the field comes last and is optional."
    ),
    do=(
        "Where it comes last and is `optional`, upgrade the receiver first. Otherwise make it so, "
        "or add a message with the field."
    ),
    at="messages.LampRead.fields",
    before="",
    after="colour: {type: u8}",
    look=_look,
)
