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
        "Frames are longer: an end refuses those of the other edition, unless the field comes "
        "last and is optional."
    ),
    do="Add a message with the field, or put it last and say `optional: true`.",
    at="messages.LampRead.fields",
    before="",
    after="colour: {type: u8}",
    look=_look,
)
