"""Rule: a number that is read as signed is unsigned itself, and as wide."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import owned_numbers
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for path, fields in owned_numbers(spec):
        for name, field in fields.items():
            if field.signed_as is not None:
                here = (*path, name, "signed_as")
                yield from _type(here, field, field.signed_as)
                yield from _in_list(here, field)


def _type(path: KeyPath, field: NumberField, signed_as: str) -> Iterator[Problem]:
    types = NUMBER_TYPES.values()
    signed = [type_.name for type_ in types if type_.low < 0 and not type_.is_float]
    type_ = NUMBER_TYPES.get(field.type)
    if signed_as not in signed:
        yield Problem(path, f"`{signed_as}` is no signed type", did_you_mean(signed_as, signed))
    elif type_ is not None and type_.low < 0:
        yield Problem(path, f"{type_.name} is signed already", "leave `signed_as` out")
    elif type_ is not None and type_.size != NUMBER_TYPES[signed_as].size:
        same = next(name for name in signed if NUMBER_TYPES[name].size == type_.size)
        yield Problem(path, f"{signed_as} is not as wide as {type_.name}", f"write {same}")


def _in_list(path: KeyPath, field: NumberField) -> Iterator[Problem]:
    if field.counted_by is not None:
        what = "numbers in a list have no properties that could read them as signed"
        yield Problem(path, what, "give the list an `element` with fields", on_key=True)


RULE = StructureRule(
    id="signed-as",
    title="A number that is read as signed is unsigned itself, and as wide",
    why="The bits are the same and only their meaning differs: `signed_position` is the value of "
    "`position` where it wraps round below zero.",
    bad="position: {type: u16, signed_as: i8}",
    good="position: {type: u16, signed_as: i16}",
    look=_look,
)
