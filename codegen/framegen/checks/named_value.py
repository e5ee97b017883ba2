"""Rule: a named value is inside the field's range, and has one name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import numbers
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for path, field in numbers(spec):
        first: dict[int, str] = {}
        for name, named in field.values.items():
            here = (*path, "values", name, "value")
            other = first.setdefault(named.value, name)
            if other != name:
                yield Problem(
                    here,
                    f"`{other}` and `{name}` are both {named.value}",
                    "keep one of the names",
                    also=((*path, "values", other, "value"), f"`{other}` has it first"),
                )
            yield from _outside(here, field, name, named.value)


def _outside(path: KeyPath, field: NumberField, name: str, value: int) -> Iterator[Problem]:
    type_ = NUMBER_TYPES.get(field.type)
    if type_ is None:
        return
    low, high = type_.low, type_.high
    if field.range is not None:
        low = field.range.low
        high = type_.high if field.range.high is None else field.range.high
    if not low <= value <= high:
        yield Problem(
            path,
            f"`{name}` is {value}, outside {low}..{high}",
            "widen the range or correct the value",
        )


RULE = StructureRule(
    id="named-value",
    title="A named value is inside the field's range, and has one name",
    why="A name for a value that is always refused is useless; with two names for one value it is "
    "unclear which of them a decoder shows.",
    bad="{type: u8, range: 0..100, values: {off: {value: 255}}}",
    good="{type: u8, range: 0..100, values: {off: {value: 0}}}",
    look=_look,
)
