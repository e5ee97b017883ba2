"""The generated library of each protocol, and what it makes of values and of lines."""

import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from types import ModuleType
from typing import Any

from framegen.language.values import Direction
from framegen.model.layout import MessageLayout
from framegen.model.slots import Items

from tests.factories import library, library_of
from tests.protocols.peer import Values
from tests.protocols.specs import FILES

# What was imported of each of them: what a library holds does not change while it is used.
_KEPT: dict[str, dict[str, ModuleType]] = {}


class Libraries:
    """Libraries that are made when they are first asked for, and stay imported until the end."""

    def __init__(self, until: ExitStack) -> None:
        self._until = until
        self._made: dict[str, ModuleType] = {}

    def __getitem__(self, name: str) -> ModuleType:
        if name not in self._made:
            self._made[name] = self._until.enter_context(_imported(name))
        return self._made[name]


@contextmanager
def _imported(name: str) -> Iterator[ModuleType]:
    with library(library_of(FILES[name])) as made:
        package = made.__name__
        sys.modules.update(_KEPT.get(name, {}))
        yield sys.modules[package]
        _KEPT[name] = {
            each: module for each, module in sys.modules.items() if each.split(".")[0] == package
        }


def direction_of(made: ModuleType, way: Direction) -> Any:
    """Return a direction as a library has it."""
    return made.Direction[f"{way.sender}_to_{way.receiver}".upper()]


def made_of(made: ModuleType, layout: MessageLayout, values: Values) -> Any:
    """Return a message of the library with these values."""
    counter = layout.frame.counter
    named = {} if counter is None else {counter.name: values.get(counter.name, 0)}
    given = [_item(slot, values[slot.name]) for slot in layout.arguments if slot.name not in named]
    return getattr(made, layout.name)(*given, **named)


def _item(slot: Any, value: Any) -> Any:
    if isinstance(slot, Items) and slot.element is not None:
        return [tuple(item.values()) for item in value]
    return value


def values_in(layout: MessageLayout, message: Any) -> Values:
    """Return the values of a message of a library, by the names that the spec gives them."""
    found: Values = {}
    for slot in layout.arguments:
        value = getattr(message, _attribute(message, slot.name))
        if isinstance(slot, Items) and slot.text is None:
            value = [_element(slot, item) for item in value]
        elif slot.role == "packed":
            value = list(value)
        found[slot.name] = value
    return found


def _element(items: Items, item: Any) -> Any:
    if items.element is None:
        return item
    return {field.name: getattr(item, _attribute(item, field.name)) for field in items.fields}


def _attribute(owner: object, name: str) -> str:
    """Return the name of a field, which is another where it is a word of Python."""
    return name if hasattr(type(owner), name) else f"{name}_"
