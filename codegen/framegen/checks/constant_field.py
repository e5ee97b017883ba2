"""Rule: a field that never changes has one value, which fits its type."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import numbers
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import ALL_TYPES
from framegen.model.layout import is_constant

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath

_OWN = ("range", "values", "limits", "signed_as", "scale", "unit", "bits", "text", "optional")
_LISTS = ("counted_by", "sized_by")


def _look(spec: Spec) -> Iterator[Problem]:
    for path, field in numbers(spec):
        if is_constant(field):
            yield from _misuse(path, field)


def _misuse(path: KeyPath, field: NumberField) -> Iterator[Problem]:
    name = path[-1]
    key = "always" if field.always is not None else "reserved"
    value = field.always if field.always is not None else field.reserved
    if field.always is not None and field.reserved is not None:
        what = f"`{name}` is both `always` and `reserved`"
        hint = "keep `always` if other values are refused, and `reserved` if they are ignored"
        yield Problem((*path, "reserved"), what, hint, on_key=True)
    type_ = ALL_TYPES.get(field.type)
    if type_ is not None and value is not None and not type_.low <= value <= type_.high:
        what = f"{value} is no {type_.name}: it holds {type_.low}..{type_.high}"
        yield Problem((*path, key), what, "correct the value, or take another type")
    for other in (*_OWN, *_LISTS):
        if getattr(field, other):
            what = f"`{name}` is {_KINDS[key]}, which has no `{other}`"
            hint = f"remove `{other}`, or `{key}`"
            if other in _LISTS:
                hint = f"write `count`, if it always has the same size; else remove `{key}`"
            yield Problem((*path, other), what, hint, on_key=True)


_KINDS = {"always": "a constant", "reserved": "reserved"}

RULE = StructureRule(
    id="constant-field",
    title="A field that never changes has one value, which fits its type",
    why="Nobody gives it and nobody reads it: the library writes it. With `always` another value "
    "is refused, with `reserved` it is ignored.",
    bad="zero: {type: u8, always: 0, range: 0..1}",
    good="zero: {type: u8, always: 0}",
    look=_look,
)
