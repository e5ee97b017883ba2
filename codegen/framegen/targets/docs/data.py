"""The protocol as the page's own decoder reads it: the layout as plain values, nothing of prose."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.language.spec import BodyPart
from framegen.model.envelope import part_size
from framegen.model.layout import Repeat
from framegen.targets.docs.address import message_page

if TYPE_CHECKING:
    from framegen.model.layout import MessageLayout, WireField
    from framegen.model.model import Model


def protocol_data(model: Model) -> dict[str, Any]:
    """Everything that decoding and encoding need."""
    frame = model.frame
    return {
        "name": model.spec.protocol.name,
        "byteOrder": model.spec.byte_order,
        "header": list(frame.header),
        "length": {"name": frame.length_name, "at": frame.length_at, "size": frame.length.size},
        "id": {"name": frame.id_name, "at": frame.id_at, "size": frame.id.size},
        "bodyAt": frame.body_at,
        "uncounted": frame.uncounted,
        "parts": _parts(model),
        "directions": [
            {"key": way.key, "text": f"{way.sender} to {way.receiver}"} for way in model.directions
        ],
        "messages": [_message(message) for message in model.messages.values()],
    }


def _parts(model: Model) -> list[dict[str, Any]]:
    parts: list[dict[str, Any]] = []
    at = 0
    for name, part in model.spec.frame.items():
        if not isinstance(part, BodyPart):
            parts.append({"name": name, "is": part.is_, "at": at, "size": part_size(part)})
        at += part_size(part)
    return parts


def _message(message: MessageLayout) -> dict[str, Any]:
    lengths, repeat = message.lengths, message.repeat
    return {
        "name": message.name,
        "page": message_page(message.name),
        "id": message.id,
        "direction": message.direction.key,
        "summary": message.message.summary,
        "example": _example(message),
        "lengths": {"first": lengths[0], "last": lengths[-1], "step": lengths.step},
        "numbers": [_field(field) for field in message.numbers],
        "list": None
        if repeat is None
        else {
            "name": repeat.name,
            "element": repeat.element,
            "counter": repeat.counter.name,
            "at": repeat.offset,
            "size": repeat.size,
            "low": repeat.low,
            "high": repeat.high,
            "fields": [_field(field) for field in repeat.fields],
        },
    }


def _example(message: MessageLayout) -> dict[str, Any]:
    """Values to begin with: those of the first example, or else the lowest."""
    if message.message.examples:
        return dict(message.message.examples[0].values)
    return {
        argument.name: [] if isinstance(argument, Repeat) else argument.low
        for argument in message.arguments
    }


def _field(field: WireField) -> dict[str, Any]:
    """A number: `at` counts from the first byte of the frame, or of the element."""
    return {
        "name": field.name,
        "at": field.offset,
        "size": field.wire.size,
        "signed": field.wire.low < 0,
        "low": field.low,
        "high": field.high,
        "unit": field.field.unit,
        "names": {name: value.value for name, value in field.field.values.items()},
    }
