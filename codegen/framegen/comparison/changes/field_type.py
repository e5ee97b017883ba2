"""Change: a field has another number type."""

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
        yield from changed("field-type", each, "type", each.old.type, each.new.type)


RULE = ChangeRule(
    id="field-type",
    title="A field has another number type",
    subject="field",
    why=(
        "A field of another size moves all that is behind it; one of another sign or kind is read "
        "as another number."
    ),
    do=(
        "Add a message; or add a field at the end that is optional, and upgrade the receiver first."
    ),
    at="messages.LampRead.fields",
    before="lamp_id: {type: u8}",
    after="lamp_id: {type: u16}",
    look=_look,
)
