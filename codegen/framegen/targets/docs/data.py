"""The protocol as data for the decoder page: slots as plain values, without prose."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.explanation import refusals
from framegen.model.slots import Body, Constant, Items, Number
from framegen.targets.docs.address import message_page

if TYPE_CHECKING:
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Slot

# The reasons for which bytes are no frame, by what the script calls them.
_REASONS = {
    "tooShort": refusals.TOO_SHORT,
    "trailing": refusals.TRAILING_BYTES,
    "header": refusals.BAD_HEADER,
    "length": refusals.LENGTH_MISMATCH,
    "count": refusals.COUNT_MISMATCH,
    "unknown": refusals.UNKNOWN_COMMAND,
    "range": refusals.OUT_OF_RANGE,
}


def protocol_data(model: Model) -> dict[str, Any]:
    """Return all that decoding and encoding need.

    The slots of a message are those of `frame`, with its fields where the body is. Its frame has
    `size` bytes and those of as many elements as `counts` allows.
    """
    return {
        "name": model.spec.protocol.name,
        "reasons": _REASONS,
        "directions": [
            {"key": way.key, "sender": way.sender, "text": f"{way.sender} to {way.receiver}"}
            for way in model.directions
        ],
        "frame": {
            "least": model.frame.least,
            "uncounted": model.frame.uncounted,
            "slots": [_slot(slot) for slot in model.frame.slots],
        },
        "messages": [_message(message) for message in model.messages.values()],
    }


def _message(message: MessageLayout) -> dict[str, Any]:
    return {
        "name": message.name,
        "page": message_page(message.name),
        "id": message.id,
        "direction": message.direction.key,
        "summary": message.message.summary,
        "example": _example(message),
        "fields": [_slot(slot) for slot in message.fields],
        "counts": {"low": message.counts[0], "high": message.counts[-1]},
        "size": message.size_at(0),
    }


def _example(message: MessageLayout) -> dict[str, Any]:
    """Return values to begin with: those of the first example, or else the lowest."""
    if message.message.examples:
        return dict(message.message.examples[0].values)
    return {
        argument.name: [] if isinstance(argument, Items) else argument.low
        for argument in message.arguments
    }


def _slot(slot: Slot) -> dict[str, Any]:
    """Return a slot; `at` counts from the first byte of the frame or, below zero, from its end.

    In an element of a list it counts from the first byte of the element.
    """
    placed = {"role": slot.role, "name": slot.name, "at": slot.at}
    match slot:
        case Body():
            return placed
        case Constant():
            return placed | {"size": slot.size, "bytes": list(slot.data)}
        case Number():
            return placed | {"size": slot.size, **_number(slot)}
        case Items():
            fields = [_slot(field) for field in slot.fields]
            return placed | {"size": slot.size, "element": slot.element, "fields": fields}


def _number(number: Number) -> dict[str, Any]:
    said, scale = number.field, number.field.scale
    return {
        "order": number.order,
        "signed": number.number_type.low < 0,
        "low": number.low,
        "high": number.high,
        "unit": said.unit,
        "scale": scale and {"step": f"{scale.step:f}", "unit": scale.unit},
        "names": {name: value.value for name, value in said.values.items()},
    }
