"""Rule: every name can be a name in the generated code."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import GroupField, NumberField
from framegen.names import (
    ELEMENT_ATTRIBUTES,
    MESSAGE_ATTRIBUTES,
    PYTHON_BUILTINS,
    PYTHON_KEYWORDS,
)

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
    for section in ("sources", "endpoints", "frame", "lookalikes"):
        for name in getattr(spec, section):
            yield from _snake((section, name), name)
    for name, lookalike in spec.lookalikes.items():
        for part in lookalike.frame or {}:
            yield from _snake(("lookalikes", name, "frame", part), part)
    for name, message in spec.messages.items():
        yield from _pascal(("messages", name), name, on_key=True)
        yield from _in_message(("messages", name, "fields"), name, message)


def _in_message(path: KeyPath, message_name: str, message: Message) -> Iterator[Problem]:
    for name, field in message.fields.items():
        here = (*path, name)
        yield from _field(here, name, message_name, MESSAGE_ATTRIBUTES)
        if isinstance(field, NumberField):
            yield from _values(here, field)
            continue
        yield from _pascal((*here, "element"), field.element, on_key=False)
        yield from _in_group((*here, "fields"), field)


def _in_group(path: KeyPath, group: GroupField) -> Iterator[Problem]:
    for name, field in group.fields.items():
        yield from _field((*path, name), name, group.element, ELEMENT_ATTRIBUTES)
        yield from _values((*path, name), field)


def _values(path: KeyPath, field: NumberField) -> Iterator[Problem]:
    for name in field.values:
        yield from _snake((*path, "values", name), name)


def _field(path: KeyPath, name: str, owner: str, taken: frozenset[str]) -> Iterator[Problem]:
    yield from _snake(path, name)
    what = None
    if name in PYTHON_BUILTINS:
        what = f"a field called `{name}` would hide Python's own `{name}`"
    elif name in taken:
        what = f"every {owner} has `{name}` of its own already"
    if what is not None:
        yield Problem(path, what, _longer(name, owner), on_key=True)


def _pascal(path: KeyPath, name: str, *, on_key: bool) -> Iterator[Problem]:
    if _PASCAL.fullmatch(name) is None:
        proposed = "".join(word.capitalize() for word in _words(name))
        hint = f"write `{proposed}`" if _PASCAL.fullmatch(proposed) else ""
        yield Problem(path, f"`{name}` is no name in PascalCase", hint, on_key)


def _snake(path: KeyPath, name: str, *, on_key: bool = True) -> Iterator[Problem]:
    if name in PYTHON_KEYWORDS:
        yield Problem(path, f"`{name}` is a word of Python itself", "choose another name", on_key)
    elif _SNAKE.fullmatch(name) is None:
        proposed = "_".join(_words(name)).lower()
        hint = f"write `{proposed}`" if _SNAKE.fullmatch(proposed) else ""
        yield Problem(path, f"`{name}` is no name in snake_case", hint, on_key)


def _longer(name: str, owner: str) -> str:
    """Hint at a name that says whose it is: `servo_id` for the `id` of a ServoTarget."""
    words = _words(owner)
    return f"say whose it is, like `{words[0].lower()}_{name}`" if words else ""


def _words(name: str) -> list[str]:
    """Split `servo_move`, `ServoMove` and `servo-move` alike; nothing stranger than those."""
    return _WORD.findall(name) if _PLAIN.fullmatch(name) else []


RULE = StructureRule(
    id="identifier",
    title="Every name can be a name in the generated code",
    why="Names go into code as they are: messages as classes, fields as arguments. A name that is "
    "no identifier breaks it, and one that Python uses itself (`id`, `list`, `from`) bites later.",
    bad="fields: {id: {type: u8}}",
    good="fields: {servo_id: {type: u8}}",
    look=_look,
)
