"""Rule: every constant that the library makes of the spec has a name of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import GroupField

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath

# What every message class has already.
_ATTRIBUTES = frozenset(["VENDOR_NAME", "COMMAND", "DIRECTION", "LENGTHS", "SHAPE"])


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        path = ("messages", name, "fields")
        numbers: dict[str, NumberField] = {}
        for field_name, field in message.fields.items():
            if isinstance(field, GroupField):
                yield from _clashes((*path, field_name, "fields"), field.fields)
            else:
                numbers[field_name] = field
        yield from _clashes(path, numbers)
    yield from _directions(spec)


def _clashes(path: KeyPath, fields: dict[str, NumberField]) -> Iterator[Problem]:
    """Named values of one class that would become the same constant."""
    first: dict[str, KeyPath] = {}
    for field_name, field in fields.items():
        for value_name in field.values:
            here = (*path, field_name, "values", value_name)
            constant = f"{field_name}_{value_name}".upper()
            message = f"`{value_name}` of `{field_name}` becomes the constant {constant}, "
            if constant in _ATTRIBUTES:
                yield Problem(here, f"{message}which every message has", "rename it", on_key=True)
            elif constant in first:
                also = (first[constant], "the first is here")
                yield Problem(here, f"{message}as another does", "rename one", True, also)
            first.setdefault(constant, here)


def _directions(spec: Spec) -> Iterator[Problem]:
    """Directions that would become the same member of Direction."""
    first: dict[str, tuple[KeyPath, str]] = {}
    for name, message in spec.messages.items():
        here = ("messages", name, "direction")
        key, text = message.direction.key, str(message.direction)
        there, other = first.setdefault(key, (here, text))
        if other != text:
            told = f"`{text}` and `{other}` would both be Direction.{key.upper()}"
            yield Problem(here, told, "rename an endpoint", also=(there, "the other is here"))


RULE = StructureRule(
    id="duplicate-constant",
    title="Every constant of the library has a name of its own",
    why="A named value becomes FIELD_VALUE in its message, and a direction SENDER_TO_RECEIVER: of "
    "two with one name, one would vanish.",
    bad="vendor: {type: u8, values: {name: {value: 0, ...}}}",
    good="vendor: {type: u8, values: {none: {value: 0, ...}}}",
    look=_look,
)
