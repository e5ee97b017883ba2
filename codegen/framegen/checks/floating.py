"""Rule: a floating-point number has no keys of whole numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import numbers
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec

_HINTS = {
    "range": "say it in `about`, or in `notes`: a decoder accepts every value",
    "limits": "say it in `about`, or in `notes`",
    "values": "say in `about` what such a value means: equality of such numbers is fragile",
}


def _look(spec: Spec) -> Iterator[Problem]:
    for path, field in numbers(spec):
        type_ = NUMBER_TYPES.get(field.type)
        if type_ is None or not type_.is_float:
            continue
        for key, hint in _HINTS.items():
            if getattr(field, key):
                what = f"`{path[-1]}` is a floating-point number, which has no `{key}`"
                yield Problem((*path, key), what, hint, on_key=True)


RULE = StructureRule(
    id="floating",
    title="A floating-point number has no keys of whole numbers",
    why="Ranges, limits and named values are compared exactly, and what arrives in a "
    "floating-point number is rarely exact.",
    bad="{type: f32, range: 0..100}",
    good="{type: f32, about: The level, from 0 to 100.}",
    look=_look,
)
