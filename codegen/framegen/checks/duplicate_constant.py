"""Rule: no two constants have the same name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.language.spec import ListField

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import NumberField
    from framegen.language.values import Direction
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


def _look(model: Model) -> Iterator[Problem]:
    for name, message in model.spec.messages.items():
        path = ("messages", name, "fields")
        numbers: dict[str, NumberField] = {}
        for field_name, field in message.fields.items():
            if isinstance(field, ListField):
                yield from _clashes((*path, field_name, "fields"), field.fields)
            else:
                numbers[field_name] = field
        yield from _clashes(path, numbers)
    yield from _directions(model)


def _clashes(path: KeyPath, fields: dict[str, NumberField]) -> Iterator[Problem]:
    """Find named values and bits of one class that would have the same name."""
    first: dict[str, KeyPath] = {}
    for field_name, field in fields.items():
        named = [(key, name) for key in ("values", "bits") for name in getattr(field, key)]
        for key, name in named:
            here = (*path, field_name, key, name)
            constant = f"{field_name}_{name}".upper()
            also = (first.setdefault(constant, here), "the first is here")
            if also[0] != here:
                what = f"`{name}` of `{field_name}` becomes the constant {constant}"
                yield Problem(here, f"{what}, as another does", "rename one", True, also)
        for name in field.bits:
            here, own = (*path, field_name, "bits", name), f"{field_name}_{name}"
            if own in fields:
                what = f"`{name}` of `{field_name}` becomes the property `{own}`, as a field does"
                yield Problem(here, what, "rename one", True, ((*path, own), "the field is here"))


def _directions(model: Model) -> Iterator[Problem]:
    """Find directions that would become the same constant, used or not."""
    first: dict[str, tuple[KeyPath, str]] = {}
    for path, direction in _ways(model):
        key, text = direction.key, str(direction)
        there, other = first.setdefault(key, (path, text))
        if other != text:
            what = f"`{text}` and `{other}` would both be the constant {key.upper()}"
            also = (there, "the other is here")
            yield Problem(path, what, "rename an endpoint", path[0] == "endpoints", also)


def _ways(model: Model) -> Iterator[tuple[KeyPath, Direction]]:
    for name, message in model.spec.messages.items():
        yield ("messages", name, "direction"), message.direction
    for direction in model.roles.directions:
        yield ("endpoints", direction.sender), direction


RULE = ModelRule(
    id="duplicate-constant",
    title="No two constants have the same name",
    why="A named value becomes FIELD_VALUE in its message, and a direction SENDER_TO_RECEIVER: "
    "one of two equal names would be lost.",
    bad="{lamp: {values: {is_off: {value: 0, ...}}}, lamp_is: {values: {off: {value: 0, ...}}}}",
    good="{lamp: {values: {off: {value: 0, ...}}}, lamp_is: {values: {off: {value: 0, ...}}}}",
    look=_look,
)
