"""Rule: length and count have room for every legal frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.pluralize import pluralize

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Items
    from framegen.reading.yamltree import KeyPath

# What a length of two bytes can say. A decoder holds the longest legal frame, whatever arrives: of
# a length of four bytes, one false header would have it wait for gigabytes.
LONGEST = 0xFFFF
_OF_ANY = f"and no frame may have more than {LONGEST}"


def _look(model: Model) -> Iterator[Problem]:
    for name, message in model.messages.items():
        frame, fixed = message.frame, message.formula.constant
        path: KeyPath = ("messages", name)
        if fixed > min(frame.length.high, LONGEST):
            ends = f"and a {frame.length.number_type.name} ends at {frame.length.high}"
            bound = ends if frame.length.high <= LONGEST else _OF_ANY
            what = f"{name} needs a {frame.length.name} of {fixed}, {bound}"
            yield Problem(path, what, on_key=True)
        elif message.items is not None:
            yield from _list((*path, "fields", message.items.name), message, message.items)


def _list(path: KeyPath, message: MessageLayout, items: Items) -> Iterator[Problem]:
    fixed, declared = message.formula.constant, items.field.count
    most = items.high if declared is None else max(declared.low, declared.high or items.high)
    at, on_key = ((*path, "count"), False) if declared is not None else (path, True)
    room, limit = _room(message, items)
    fits = (LONGEST - fixed) // items.size
    if most > fits and room > fits:
        length = fixed + most * items.size
        what = f"with {most} elements, {message.name} has a {message.frame.length.name} of {length}"
        hint = f"write `count: {items.low}..{fits}`" if items.low <= fits else ""
        yield Problem(at, f"{what}, {_OF_ANY}", hint, on_key)
    elif max(most, 1) > room:
        what = f"{limit} has room for {pluralize(room, 'element')}, and not for {max(most, 1)}"
        hint = f"write {items.low}.. for as many as there is room for" if items.low <= room else ""
        yield Problem(at, what, hint if room else "", on_key)


def _room(message: MessageLayout, items: Items) -> tuple[int, str]:
    """Return how many elements length and count have room for, and which of them is the limit."""
    by_length = (message.frame.length.high - message.formula.constant) // items.size
    by_count = items.counter.number_type.high
    if by_count < by_length:
        return by_count, f"`{items.counter.name}`"
    return by_length, f"`{message.frame.length.name}`"


RULE = ModelRule(
    id="frame-too-long",
    title="Length and count have room for every legal frame",
    why="A frame whose length does not fit cannot be sent, and must not be cut silently. A "
    "decoder holds the longest frame: 64 KiB are enough for any serial line.",
    bad="count: 1..300  # where the length is a u8",
    good="count: 1..",
    look=_look,
)
