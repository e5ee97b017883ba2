"""Change: the class of the elements has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.language.spec import ListField

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.fields.twins:
        if isinstance(each.old, ListField) and isinstance(each.new, ListField):
            old, new = each.old.element, each.new.element
            yield from changed("element", each, "element", old, new, "element")


RULE = ChangeRule(
    id="element",
    title="The class of the elements has another name",
    subject="program",
    why="Programs build the elements by the name of their class.",
    do="Change it together with another break of programs.",
    at="messages.LampsSet",
    before="fields: {lamps: {element: Lamp, count: 2, fields: {lamp_id: {type: u8}}}}",
    after="fields: {lamps: {element: Spot, count: 2, fields: {lamp_id: {type: u8}}}}",
    look=_look,
)
