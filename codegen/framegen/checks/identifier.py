"""Rule: every name is an identifier in any language."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from framegen.checks.frames import parts
from framegen.checks.named import families, former_names
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import AddressPart, NumberField

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message, Spec
    from framegen.reading.yamltree import KeyPath

_PASCAL = re.compile(r"[A-Z][A-Za-z0-9]*")
_SNAKE = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*")
_PLAIN = re.compile(r"[A-Za-z0-9 _-]+")
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|[0-9]+")


def _look(spec: Spec) -> Iterator[Problem]:
    yield from _snake(("protocol", "name"), spec.protocol.name, on_key=False)
    yield from _pascal(("protocol", "client"), spec.protocol.client, on_key=False)
    for section in ("sources", "endpoints", "frames", "lookalikes"):
        for name in getattr(spec, section):
            yield from _snake((section, name), name)
    for path, part in parts(spec):
        yield from _snake(path, str(path[-1]))
        for name in part.values if isinstance(part, AddressPart) else ():
            yield from _snake((*path, "values", name), name)
    for name, message in spec.messages.items():
        yield from _pascal(("messages", name), name, on_key=True)
        yield from _in_message(("messages", name), message)
    for path, named in families(spec):
        for name, thing in named.items():
            for place, former in former_names((*path, name), thing):
                spelt = _pascal if path == ("messages",) else _snake
                yield from spelt(place, former, on_key=False)
    for key in ("hold", "present", "targets") if spec.pose is not None else ():
        yield from _snake(("pose", key), getattr(spec.pose, key), on_key=False)


def _in_message(path: KeyPath, message: Message) -> Iterator[Problem]:
    if message.method is not None:
        yield from _snake((*path, "method"), message.method.name, on_key=False)
    for name, field in message.fields.items():
        here = (*path, "fields", name)
        yield from _snake(here, name)
        if isinstance(field, NumberField):
            yield from _values(here, field)
            continue
        yield from _pascal((*here, "element"), field.element, on_key=False)
        for inner_name, inner in field.fields.items():
            yield from _snake((*here, "fields", inner_name), inner_name)
            yield from _values((*here, "fields", inner_name), inner)


def _values(path: KeyPath, field: NumberField) -> Iterator[Problem]:
    for key in ("values", "bits"):
        for name in getattr(field, key):
            yield from _snake((*path, key, name), name)


def _pascal(path: KeyPath, name: str, *, on_key: bool) -> Iterator[Problem]:
    if _PASCAL.fullmatch(name) is None:
        proposed = "".join(word.capitalize() for word in _words(name))
        hint = f"write `{proposed}`" if _PASCAL.fullmatch(proposed) else ""
        yield Problem(path, f"`{name}` is no name in PascalCase", hint, on_key)


def _snake(path: KeyPath, name: str, *, on_key: bool = True) -> Iterator[Problem]:
    if _SNAKE.fullmatch(name) is None:
        proposed = "_".join(_words(name)).lower()
        hint = f"write `{proposed}`" if _SNAKE.fullmatch(proposed) else ""
        yield Problem(path, f"`{name}` is no name in snake_case", hint, on_key)


def _words(name: str) -> list[str]:
    """Split `servo_move`, `ServoMove` and `servo-move` into the same words."""
    return _WORD.findall(name) if _PLAIN.fullmatch(name) else []


RULE = StructureRule(
    id="identifier",
    title="Every name is an identifier in any language",
    why="Names go into code, files and addresses: messages, elements and the client in "
    "PascalCase, all others in snake_case. A word that a language has reserved is allowed "
    "here: its target adds a suffix.",
    bad="fields: {Servo-ID: {type: u8}}",
    good="fields: {servo_id: {type: u8}}",
    look=_look,
)
