"""Rule: every list is counted by an earlier number that does nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.counters import counter_problems
from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        for field_name, field in message.fields.items():
            here = ("messages", name, "fields", field_name, "counted_by")
            counter = field.counted_by
            if counter is None:
                continue
            yield from counter_problems(here, name, message, field_name, counter, [])
            if counter == field.sized_by:
                what = f"`{counter}` cannot count both elements and bytes"
                hint = "leave out `sized_by` if it counts elements, else `counted_by`"
                yield Problem(here, what, hint)


RULE = StructureRule(
    id="counted-by",
    title="Every list is counted by an earlier number that does nothing else",
    why="A decoder reads from front to back: it must know how many elements come before the first. "
    "The encoder works the count out, so it can carry no other meaning.",
    bad="{lamps: {type: u8, counted_by: lamp_cuont}, lamp_count: {type: u8}}",
    good="{lamp_count: {type: u8}, lamps: {type: u8, counted_by: lamp_count}}",
    look=_look,
)
