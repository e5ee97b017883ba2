"""Rule: an element of a list has fields."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import ListField

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        for field_name, field in message.fields.items():
            if isinstance(field, ListField) and not field.fields:
                yield Problem(
                    ("messages", name, "fields", field_name, "fields"),
                    f"an element of `{field_name}` has no fields",
                    "describe at least one",
                )


RULE = StructureRule(
    id="empty-element",
    title="An element of a list has fields",
    why="Elements of no bytes cannot be counted from the length of a frame.",
    bad="lamps: {element: Lamp, fields: {}}",
    good="lamps: {element: Lamp, fields: {lamp_id: {type: u8}}}",
    look=_look,
)
