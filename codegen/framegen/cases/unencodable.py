"""Values that no frame can carry: each number and each list just beyond its bounds."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.cases.valid import values_at
from framegen.model.slots import Items

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Number

# A list that may be longer than this is not made one longer still.
_ENOUGH = 0x100


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
            if isinstance(slot, Items):
                yield from _lists(message, slot)
            else:
                yield from _numbers(message, slot, [slot.name])


def _lists(message: MessageLayout, items: Items) -> Iterator[UnencodableValues]:
    for count in items.low - 1, items.high + 1:
        if 0 <= count <= _ENOUGH:
            values = values_at(message, "low", count)
            yield UnencodableValues(f"{message.name}: {count} {items.name}", message, values)
    for field in items.fields if items.high else ():
        inner = [] if items.element is None else [field.name]
        yield from _numbers(message, field, [items.name, 0, *inner])


def _numbers(
    message: MessageLayout, number: Number, path: list[str | int]
) -> Iterator[UnencodableValues]:
    values = values_at(message, "low", max(message.counts[0], min(message.counts[-1], 1)))
    for value in number.low - 1, number.high + 1:
        wrong: Any = deepcopy(values)
        within = wrong
        for step in path[:-1]:
            within = within[step]
        within[path[-1]] = value
        yield UnencodableValues(f"{message.name}: a {number.name} of {value}", message, wrong)
