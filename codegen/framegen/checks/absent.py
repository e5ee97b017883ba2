"""Rule: absence is marked by the values of one field."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import owned_numbers
from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for path, fields in owned_numbers(spec):
        first: KeyPath | None = None
        for name, field in fields.items():
            marked = [key for key, named in field.values.items() if named.absent]
            if not marked:
                continue
            here = (*path, name, "values", marked[0], "absent")
            if field.counted_by is not None:
                what = "numbers in a list have no property that could say which are absent"
                yield Problem(here, what, "give the list an `element` with fields", on_key=True)
            elif first is not None:
                what = "another field already marks absence"
                also = (first, "it is here")
                yield Problem(here, what, "mark the values of one field", on_key=True, also=also)
            else:
                first = here


RULE = StructureRule(
    id="absent",
    title="Absence is marked by the values of one field",
    why="An element or a message has one property `absent`, so one field has to decide it.",
    bad="fade: {values: {off: {absent: true, ...}}}, level: {values: {off: {absent: true, ...}}}",
    good="fade: {values: {off: {...}}}, level: {values: {off: {absent: true, ...}}}",
    look=_look,
)
