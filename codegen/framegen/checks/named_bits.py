"""Rule: named bits lie inside an unsigned number, and do not overlap."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import owned_numbers
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES
from framegen.model.layout import is_list

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.number_types import NumberType
    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for path, fields in owned_numbers(spec):
        for name, field in fields.items():
            type_ = NUMBER_TYPES.get(field.type)
            if field.bits and type_ is not None:
                yield from _bits((*path, name, "bits"), name, field, type_)


def _bits(path: KeyPath, name: str, field: NumberField, type_: NumberType) -> Iterator[Problem]:
    if type_.is_float or type_.low < 0:
        what = f"only bits of an unsigned number have names, and `{name}` is of type {type_.name}"
        yield Problem(path, what, f"write `type: u{type_.bits}`", on_key=True)
    if is_list(field):
        what = "numbers in a list have no properties that could have the names of bits"
        yield Problem(path, what, "give the list an `element` with fields", on_key=True)
    taken: dict[int, str] = {}
    for key, bits in field.bits.items():
        here = (*path, key)
        low, high = bits.at.low, bits.at.high
        if high is None or low > high:
            what = f"the bits {bits.at} have no end, or end before they begin"
            yield Problem(here, what, "write the lowest bit first, like 0..6")
            continue
        if low < 0 or high >= type_.bits:
            what = f"`{key}` is at {bits.at}, and a {type_.name} has the bits 0..{type_.bits - 1}"
            yield Problem(here, what, "the lowest bit is 0; or take a wider type")
            continue
        other = next((taken[at] for at in range(low, high + 1) if at in taken), None)
        if other is not None:
            what = f"`{other}` and `{key}` share a bit"
            also = ((*path, other), f"`{other}` is here")
            yield Problem(here, what, "give each bit one name", also=also)
        taken |= dict.fromkeys(range(low, high + 1), key)


RULE = StructureRule(
    id="named-bits",
    title="Named bits lie inside an unsigned number, and do not overlap",
    why="Each name is a property of the message and a mask for its number: a bit outside is always "
    "0, and a bit of two names says two things at once.",
    bad="{type: u8, bits: {hot: 8}}",
    good="{type: u8, bits: {hot: 7}}",
    look=_look,
)
