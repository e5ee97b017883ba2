"""Rule: length and count have room for every legal frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.checks.rule import ModelRule, Problem
from framegen.model.layout import LONGEST
from framegen.model.slots import Number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Items
    from framegen.reading.yamltree import KeyPath

_OF_ANY = f"and no frame may have more than {LONGEST}"


def _look(model: Model) -> Iterator[Problem]:
    for name, message in model.messages.items():
        fixed = _fixed(message)
        part = message.frame.length_part
        path: KeyPath = ("messages", name)
        longest = LONGEST if part is None else min(part.high, LONGEST)
        if fixed > longest:
            needs = f"{name} needs a {_length(message)} of {fixed}"
            bound = _OF_ANY
            if part is not None and part.high <= LONGEST:
                bound = f"and a {part.number_type.name} ends at {part.high}"
            yield Problem(path, f"{needs}, {bound}", on_key=True)
        elif message.items is not None:
            yield from _list((*path, "fields", message.items.name), message, message.items)


def _fixed(message: MessageLayout) -> int:
    """Return the length without the list, and with all that may be absent."""
    if message.optional:
        return message.formula.at(message.counts[-1])
    return message.formula.constant


def _length(message: MessageLayout) -> str:
    part = message.frame.length_part
    return "size" if part is None else part.name


def _list(path: KeyPath, message: MessageLayout, items: Items) -> Iterator[Problem]:
    fixed, declared = message.formula.constant, items.field.count
    most = items.high if declared is None else max(declared.low, declared.high or items.high)
    at, on_key = ((*path, "count"), False) if declared is not None else (path, True)
    room, limit = _room(message, items)
    fits = (LONGEST - fixed) // items.size
    if most > fits and room > fits:
        length = fixed + most * items.size
        what = f"with {most} elements, {message.name} has a {_length(message)} of {length}"
        hint = f"write `count: {items.low}..{fits}`" if items.low <= fits else ""
        yield Problem(at, f"{what}, {_OF_ANY}", hint, on_key)
    elif max(most, 1) > room:
        what = f"{limit} has room for {pluralize(room, 'element')}, and not for {max(most, 1)}"
        hint = f"write {items.low}.. for as many as there is room for" if items.low <= room else ""
        yield Problem(at, what, hint if room else "", on_key)


def _room(message: MessageLayout, items: Items) -> tuple[int, str]:
    """Return how many elements length and counts have room for, and which of them is the limit."""
    part = message.frame.length_part
    most = LONGEST if part is None else part.high
    limits = [((most - message.formula.constant) // items.size, _length(message))]
    for counter in message.fields:
        if isinstance(counter, Number) and counter.counts:
            each = items.size if counter.role == "size" else 1
            limits.append((counter.number_type.high // each, counter.name))
    room, name = min(limits, key=lambda limit: limit[0])
    return room, f"`{name}`"


RULE = ModelRule(
    id="frame-too-long",
    title="Length and count have room for every legal frame",
    why="A frame whose length does not fit cannot be sent, and must not be cut silently. A "
    "decoder holds the longest frame: 64 KiB are enough for any serial line.",
    bad="count: 1..300  # where the length is a u8",
    good="count: 1..",
    look=_look,
)
