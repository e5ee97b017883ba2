"""Rule: every class of the library has a name of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import GroupField
from framegen.names import LIBRARY_NAMES, PYTHON_CLASSES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath

_LIBRARY = {name.lower(): name for name in LIBRARY_NAMES}


def _look(spec: Spec) -> Iterator[Problem]:
    # Compared in lower case, since ServoMove and Servomove become one word where they are methods.
    first: dict[str, tuple[KeyPath, str]] = {}
    for path, name, on_key in _classes(spec):
        lower = name.lower()
        if name in PYTHON_CLASSES:
            yield Problem(path, f"Python has a `{name}` already", "choose another name", on_key)
        elif lower in _LIBRARY:
            exported = _LIBRARY[lower]
            message = f"the library exports a `{exported}` whatever the protocol"
            yield Problem(path, message, "choose another name", on_key)
        elif lower in first:
            there, other = first[lower]
            message = (
                f"there are two classes called `{name}`"
                if name == other
                else f"`{name}` and `{other}` differ only in capitals"
            )
            also = (there, "the first is here")
            yield Problem(path, message, "choose another name", on_key, also)
        else:
            first[lower] = (path, name)


def _classes(spec: Spec) -> Iterator[tuple[KeyPath, str, bool]]:
    for name in spec.messages:
        yield ("messages", name), name, True
    for name, message in spec.messages.items():
        for field_name, field in message.fields.items():
            if isinstance(field, GroupField):
                path = ("messages", name, "fields", field_name, "element")
                yield path, field.element, False


RULE = StructureRule(
    id="duplicate-name",
    title="Every class of the library has a name of its own",
    why="Messages and elements become classes side by side, next to those that the library always "
    "has: of two with one name, one would vanish.",
    bad="messages: {Message: {id: 1, ...}}",
    good="messages: {ShowMessage: {id: 1, ...}}",
    look=_look,
)
