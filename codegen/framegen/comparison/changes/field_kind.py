"""Change: a number became a list of elements, or the other way round."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import called
from framegen.language.spec import ListField

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.fields.twins:
        old, new = (isinstance(one, ListField) for one in (each.old, each.new))
        if old != new:
            kind = "a list of elements" if new else "a number, or a list of numbers,"
            text = f"{called(each.new_path)} is {kind} now"
            yield Change("field-kind", each.old_path, each.new_path, text)


RULE = ChangeRule(
    id="field-kind",
    title="A number became a list of elements, or the other way round",
    subject="field",
    why=(
        "The argument of the class is another, and the bytes of the frame mean something else "
        "unless each element is one number of the same type."
    ),
    do="Add a message.",
    at="messages.LampsSet",
    before=("fields:\n  lamp_count: {type: u8}\n  lamps: {type: u8, counted_by: lamp_count}"),
    after=(
        "fields:\n"
        "  lamp_count: {type: u8}\n"
        "  lamps:\n"
        "    element: Lamp\n"
        "    counted_by: lamp_count\n"
        "    fields: {lamp_id: {type: u8}, level: {type: u8}}"
    ),
    look=_look,
)
