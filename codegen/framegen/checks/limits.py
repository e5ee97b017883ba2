"""Rule: limits lie inside the field's range, and are the same wherever the field occurs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import numbers_of
from framegen.checks.rule import ModelRule, Problem
from framegen.language.number_types import NUMBER_TYPES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Limits, NumberField
    from framegen.language.values import Range
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


def _look(model: Model) -> Iterator[Problem]:
    first: tuple[KeyPath, Limits] | None = None
    for name, message in model.spec.messages.items():
        for path, field in numbers_of(("messages", name), message):
            if field.limits is None:
                continue
            here = (*path, "limits")
            if message.direction != model.roles.sent:
                what = f"{name} is not sent by the client, so there is nothing to limit"
                yield Problem(here, what, "leave the limits out", on_key=True)
                continue
            yield from _bounds((*here, "usual"), field.limits.usual, field)
            for other, range_ in field.limits.others.items():
                yield from _bounds((*here, "others", other), range_, field)
            first = first or (here, field.limits)
            if field.limits != first[1]:
                what = "these limits differ from those above, and a client has one pair"
                also = (first[0], "the first are here")
                yield Problem(
                    here, what, "give every field the same limits", on_key=True, also=also
                )


def _bounds(path: KeyPath, range_: Range, field: NumberField) -> Iterator[Problem]:
    type_ = NUMBER_TYPES.get(field.type)
    if range_.high is None:
        yield Problem(path, f"the limits {range_} have no end", "write both ends, like 0..1000")
        return
    if range_.low > range_.high:
        what = f"the limits {range_} begin above their end"
        yield Problem(path, what, f"write {range_.high}..{range_.low}")
        return
    if type_ is None:
        return
    low, high = type_.low, type_.high
    if field.range is not None:
        low = field.range.low
        high = type_.high if field.range.high is None else field.range.high
    for end in dict.fromkeys((range_.low, range_.high)):
        if not low <= end <= high:
            what = f"{end} is outside {low}..{high}, which the field allows"
            yield Problem(path, what, "keep the limits inside the range of the field")


RULE = ModelRule(
    id="limits",
    title="Limits lie inside the field's range, and are the same wherever the field occurs",
    why="A client refuses values outside its limits: limits beyond the range refuse nothing, and "
    "with two different pairs it is unclear which one `limits=` changes.",
    bad="level: {type: u8, limits: {usual: 0..1000}}",
    good="level: {type: u16, limits: {usual: 0..1000}}",
    look=_look,
)
