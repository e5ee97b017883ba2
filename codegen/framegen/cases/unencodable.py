"""Values that no frame can carry: each number and each list just beyond its bounds."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.cases.valid import values_at
from framegen.model.slots import Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# A list that may be longer than this is not made one longer still.
_ENOUGH = 0x100
# A character that no text of a frame has.
_FOREIGN = "é"
# Twice the highest number of the narrower of the floating-point types; the wider holds whatever
# JSON has.
_TOO_LARGE = {"f32": 2.0**129}


@dataclass(frozen=True)
class UnencodableValues:
    """Values for a message, of which one is too large, too small, or too many."""

    title: str
    message: MessageLayout
    values: Mapping[str, Any]


def unencodable(model: Model) -> Iterator[UnencodableValues]:
    """Yield values that no frame of a message can carry, for every message."""
    for message in model.messages.values():
        for slot in message.arguments:
            match slot:
                case Items():
                    yield from _lists(message, slot)
                case Packed():
                    yield from _packed(message, slot)
                case _:
                    yield from _single(message, slot, [slot.name])
        yield from _gaps(message)


def _lists(message: MessageLayout, items: Items) -> Iterator[UnencodableValues]:
    for count in items.low - 1, items.high + 1:
        if 0 <= count <= _ENOUGH:
            values = values_at(message, "low", message.counts[0])
            values[items.name] = _resized(message, items, count)
            yield UnencodableValues(f"{message.name}: {count} {items.name}", message, values)
    if items.text is not None:
        if items.high:
            yield from _instead(message, [items.name], _foreign(items))
        return
    for field in items.fields if items.high else ():
        inner = [] if items.element is None else [field.name]
        yield from _single(message, field, [items.name, 0, *inner])


def _resized(message: MessageLayout, items: Items, count: int) -> Any:
    """Return the value of a list with so many elements, whatever it allows."""
    if not items.is_fixed:
        return values_at(message, "low", count)[items.name]
    fixed = values_at(message, "low", message.counts[0])[items.name]
    return (fixed * 2)[:count]


def _foreign(items: Items) -> str:
    return (_FOREIGN * max(items.low, 1))[: items.high]


def _packed(message: MessageLayout, packed: Packed) -> Iterator[UnencodableValues]:
    for count in packed.count - 1, packed.count + 1:
        values = [packed.low] * count
        title = f"{count} {packed.name}"
        yield from _instead(message, [packed.name], values, title)
    for value in packed.low - 1, packed.high + 1:
        title = f"a {packed.name} of {value}"
        yield from _instead(message, [packed.name, 0], value, title)


def _single(
    message: MessageLayout, slot: Number | Text, path: list[str | int]
) -> Iterator[UnencodableValues]:
    if isinstance(slot, Text):
        title = f"a {slot.name} of {slot.size + 1} characters"
        yield from _instead(message, path, "~" * (slot.size + 1), title)
        yield from _instead(message, path, _FOREIGN)
    elif not slot.is_float:
        for value in slot.low - 1, slot.high + 1:
            if not slot.holds(value):
                yield from _instead(message, path, value)
    elif slot.number_type.name in _TOO_LARGE:
        yield from _instead(message, path, _TOO_LARGE[slot.number_type.name])


def _instead(
    message: MessageLayout, path: list[str | int], value: Any, title: str = ""
) -> Iterator[UnencodableValues]:
    """Yield values of which the one at a path is another."""
    counts = message.counts
    one = counts[-1] if message.optional else max(counts[0], min(counts[-1], 1))
    wrong: Any = deepcopy(values_at(message, "low", one))
    within = wrong
    for step in path[:-1]:
        within = within[step]
    within[path[-1]] = value
    named = path[-1] if isinstance(path[-1], str) else path[0]
    said = title or f"a {named} of {value}"
    yield UnencodableValues(f"{message.name}: {said}", message, wrong)


def _gaps(message: MessageLayout) -> Iterator[UnencodableValues]:
    """Yield optional fields of which one is absent, and one behind it is not."""
    named = [slot.name for slot in message.optional]
    if len(named) > 1:
        values = values_at(message, "low", message.counts[-1]) | {named[0]: None}
        title = f"{message.name}: {named[1]} without {named[0]}"
        yield UnencodableValues(title, message, values)
