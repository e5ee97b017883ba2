"""What crosses the line: the messages that an end reads in the bytes of the other."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from framegen.model.codec import values_of
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class Received:
    """A message as the end that receives it reads it."""

    message: MessageLayout
    values: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Arrival:
    """What came of some bytes: messages, and whether there was noise, with the reason for it."""

    messages: list[Received] = field(default_factory=list)
    noise: bool = False
    refusal: str = ""


def arrival(model: Model, way: Direction, data: bytes) -> Arrival:
    """Return what an end with this model makes of bytes, after which the line is quiet."""
    if not data:
        return Arrival()
    verdict = weigh_whole(model, [way], data)
    if verdict.message is not None:
        return Arrival([Received(verdict.message, values_of(verdict.message, data))])
    events = ReferenceDecoder(model, [way]).decode(data)
    found = [
        Received(event.message, values_of(event.message, event.data))
        for event in events
        if event.message is not None
    ]
    return Arrival(found, len(found) < len(events), verdict.refusal)


def column(values: dict[str, Any], path: str) -> list[Any]:
    """Return the values of a field, by path: one, or one for each element of a list."""
    name, _, inner = path.partition(".")
    value = values[name]
    if inner:
        return [item[inner] for item in value]
    if value is None:
        return []
    return list(value) if isinstance(value, list) else [value]
