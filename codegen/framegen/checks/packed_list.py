"""Rule: numbers of odd sizes stand in a list of a fixed size that fills whole bytes."""

from __future__ import annotations

from math import gcd
from typing import TYPE_CHECKING

from framegen.checks.fields import numbers
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES, PACKED_TYPES
from framegen.model.layout import is_constant, is_varying

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.number_types import NumberType
    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath

_OWN = ("values", "bits", "limits", "signed_as", "optional")
# Of a path: messages, its name, fields, the field.
_TOP = 4


def _look(spec: Spec) -> Iterator[Problem]:
    for path, field in numbers(spec):
        type_ = PACKED_TYPES.get(field.type)
        if type_ is not None:
            yield from _misuse(path, field, type_)


def _misuse(path: KeyPath, field: NumberField, type_: NumberType) -> Iterator[Problem]:
    name, here = path[-1], (*path, "type")
    wide = f"u{8 * type_.size}"
    bits = f"`{{type: {wide}, bits: {{{name}: 0..{type_.bits - 1}, ...}}}}`"
    if is_constant(field):
        what = f"`{name}` has {type_.bits} bits, and what never changes has whole bytes"
        yield Problem(here, what, f"write `type: {wide}`, with its other bits as well")
    elif len(path) > _TOP:
        what = f"`{name}` is inside an element, whose fields have whole bytes"
        yield Problem(here, what, f"write {bits}")
    elif is_varying(field):
        key = "counted_by" if field.counted_by is not None else "sized_by"
        what = f"numbers of {type_.bits} bits stand in lists of a fixed size alone"
        hint = "write `count` instead, such as `count: 16`; or take the bytes, `type: u8`"
        yield Problem((*path, key), what, hint, on_key=True)
    elif field.count is None:
        what = f"`{name}` has {type_.bits} bits, which are no whole bytes"
        hint = f"for bits of one number write {bits}; for a list of them, add `count`"
        yield Problem(here, what, f"{_meant(type_)}{hint}")
    elif field.count.low == field.count.high and field.count.low * type_.bits % 8:
        count = field.count.low
        step = 8 // gcd(8, type_.bits)
        what = f"{count} numbers of {type_.bits} bits do not fill whole bytes"
        hint = f"write a multiple of {step}, such as `count: {-(-count // step) * step}`"
        yield Problem((*path, "count"), what, hint)
    for other in _OWN:
        if getattr(field, other):
            what = f"`{name}` is a list of packed numbers, which have no `{other}`"
            yield Problem((*path, other), what, f"remove `{other}`", on_key=True)


def _meant(type_: NumberType) -> str:
    """Return a type of whole bytes that was probably meant."""
    near = (f"u{bits}" for bits in (type_.bits - 1, type_.bits + 1) if f"u{bits}" in NUMBER_TYPES)
    return next((f"did you mean `{name}`? Else " for name in near), "")


RULE = StructureRule(
    id="packed-list",
    title="Numbers of odd sizes stand in a list of a fixed size that fills whole bytes",
    why="Behind each other they fill bytes without gaps, and what follows begins with a byte of "
    "its own. Single bits, and a few next to each other, are `bits` of a number.",
    bad="channels: {type: u11, count: 15}",
    good="channels: {type: u11, count: 16}",
    look=_look,
)
