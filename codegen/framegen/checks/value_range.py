"""Rule: a range has its ends in order and inside the type."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import numbers
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import ALL_TYPES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for path, field in numbers(spec):
        range_, type_ = field.range, ALL_TYPES.get(field.type)
        if range_ is None or type_ is None:
            continue
        here = (*path, "range")
        if range_.high is not None and range_.low > range_.high:
            yield Problem(
                here,
                f"the range {range_} begins above its end",
                f"write {range_.high}..{range_.low}",
            )
            continue
        ends = (range_.low,) if range_.high is None else (range_.low, range_.high)
        for end in dict.fromkeys(ends):
            if not type_.low <= end <= type_.high:
                yield Problem(
                    here,
                    f"{end} is no {type_.name}: it holds {type_.low}..{type_.high}",
                )


RULE = StructureRule(
    id="value-range",
    title="A range has its ends in order and inside the type",
    why="A range that holds no value refuses every frame; an end outside the type is a mistake.",
    bad="{type: u8, range: 0..1000}",
    good="{type: u16, range: 0..1000}",
    look=_look,
)
