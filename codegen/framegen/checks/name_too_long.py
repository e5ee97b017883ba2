"""Rule: names are short enough for a line of code."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import owned_numbers
from framegen.checks.frames import parts
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import AddressPart, ListField
from framegen.model.exchanges import snake_case

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath

# The most characters of each kind of name. A line of code has 100, and some hold a name twice, or
# two: endpoints make a direction, fields and their values a constant, messages a handler.
_ENDPOINT = 20
_PROTOCOL = 30
_CLIENT = 30
_CLASS = 40
_METHOD = 48
_OTHERS = 60
_CONSTANT = 75
_SHOWN = 24


def _look(spec: Spec) -> Iterator[Problem]:
    yield from _name(("protocol", "name"), spec.protocol.name, _PROTOCOL, on_key=False)
    yield from _class(("protocol", "client"), spec.protocol.client, on_key=False, most=_CLIENT)
    for name in spec.endpoints:
        yield from _name(("endpoints", name), name, _ENDPOINT)
    for section in ("sources", "frames", "lookalikes"):
        for name in getattr(spec, section):
            yield from _name((section, name), name, _OTHERS)
    for path, part in parts(spec):
        name = str(path[-1])
        yield from _name(path, name, _OTHERS)
        for key in part.values if isinstance(part, AddressPart) and len(name) <= _OTHERS else ():
            yield from _name((*path, "values", key), f"{name}_{key}", _CONSTANT)
    for key in ("hold", "present", "targets") if spec.pose is not None else ():
        yield from _name(("pose", key), getattr(spec.pose, key), _METHOD, on_key=False)
    yield from _messages(spec)
    yield from _constants(spec)


def _messages(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        here = ("messages", name)
        yield from _class(here, name, on_key=True)
        if message.method is not None:
            yield from _name((*here, "method"), message.method.name, _METHOD, on_key=False)
        for key, field in message.fields.items():
            inside = (*here, "fields", key)
            yield from _name(inside, key, _OTHERS)
            if isinstance(field, ListField):
                yield from _class((*inside, "element"), field.element, on_key=False)
                for inner in field.fields:
                    yield from _name((*inside, "fields", inner), inner, _OTHERS)


def _class(path: KeyPath, name: str, *, on_key: bool, most: int = _CLASS) -> Iterator[Problem]:
    long = list(_name(path, name, most, on_key=on_key))
    yield from long
    if not long:
        yield from _name(path, snake_case(name), _METHOD, on_key=on_key)


def _constants(spec: Spec) -> Iterator[Problem]:
    for path, fields in owned_numbers(spec):
        for name, field in fields.items():
            for key in ("values", "bits") if len(name) <= _OTHERS else ():
                for each in getattr(field, key):
                    yield from _name((*path, name, key, each), f"{name}_{each}", _CONSTANT)


def _name(path: KeyPath, name: str, most: int, *, on_key: bool = True) -> Iterator[Problem]:
    if len(name) > most:
        shown = f"`{name[:_SHOWN]}...`"
        what = f"{shown} has {len(name)} characters, and may have {most}"
        yield Problem(path, what, "choose a shorter name", on_key)


RULE = StructureRule(
    id="name-too-long",
    title="Names are short enough for a line of code",
    why="Names appear in code as they are, often two in a line: a message and its handler, a "
    "field and its value.",
    bad="fields: {the_position_that_the_first_of_all_the_lamps_of_the_row_has: {type: u16}}",
    good="fields: {position: {type: u16}}",
    look=_look,
)
