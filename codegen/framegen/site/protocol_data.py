"""The protocol as data for scripts: slots as plain values, and the texts that explain them.

Numbers of eight bytes are written as text: those of JSON in a browser have fewer digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.explanation import refusals
from framegen.explanation.explanation import example_in_words, facts, named
from framegen.explanation.protocol import listed
from framegen.language.formula import Sizes
from framegen.model.data import method_terms
from framegen.model.slots import Body, Constant, Items, Number, Packed, Text
from framegen.pluralize import describe_range
from framegen.targets.docs.address import message_page

if TYPE_CHECKING:
    from collections.abc import Collection

    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Field, Slot

# The reasons for which bytes are no frame, by what the script calls them.
REASONS = {
    "tooShort": refusals.TOO_SHORT,
    "trailing": refusals.TRAILING_BYTES,
    "header": refusals.BAD_HEADER,
    "trailer": refusals.BAD_TRAILER,
    "length": refusals.LENGTH_MISMATCH,
    "count": refusals.COUNT_MISMATCH,
    "unknown": refusals.UNKNOWN_COMMAND,
    "range": refusals.OUT_OF_RANGE,
    "checksum": refusals.BAD_CHECKSUM,
}
# Numbers of so many bytes are exact in a browser.
_EXACT = 6
_ANY_BYTE = 0x100


def protocol_data(model: Model, messages: Collection[str] | None = None) -> dict[str, Any]:
    """Return all that decoding, encoding and explaining need, of some messages or of all.

    The slots of a message are those of its envelope, with its fields where the body is. Its frame
    has `size` bytes and those of as many elements as `counts` allows, or one of its `sizes`.
    """
    shown = [each for each in model.messages.values() if messages is None or each.name in messages]
    return {
        "name": model.spec.protocol.name,
        "title": model.spec.protocol.title,
        "reasons": REASONS,
        "directions": [_direction(model, way) for way in model.directions],
        # Empty where any byte may begin a frame.
        "begins": sorted(model.first_bytes) if len(model.first_bytes) < _ANY_BYTE else [],
        "frames": [_envelope(frame) for frame in model.envelopes.values()],
        "messages": [_message(message) | _said(model, message.name) for message in shown],
        **explained_elsewhere(model),
    }


def _direction(model: Model, way: Direction) -> dict[str, Any]:
    return {
        "key": way.key,
        "sender": way.sender,
        "receiver": way.receiver,
        "text": f"{way.sender} to {way.receiver}",
        "arrow": str(way),
        "opening": model.plain.opening([str(way)]),
    }


def explained_elsewhere(model: Model) -> dict[str, Any]:
    """Return the look-alikes, and the ids that are reserved."""
    lookalikes = [
        {
            "title": said.title,
            "about": said.about,
            "commands": {str(number): meaning for number, meaning in said.commands.items()},
            **({"frame": _envelope(model.lookalikes[name])} if said.frame else {}),
        }
        for name, said in model.spec.lookalikes.items()
    ]
    reserved = [
        {
            "id": each.id.one,
            "why": each.why,
            **({} if each.direction is None else {"direction": str(each.direction)}),
        }
        for each in model.spec.reserved
        if each.id is not None and each.id.one is not None
    ]
    return {"lookalikes": lookalikes, "reserved": reserved}


def _said(model: Model, name: str) -> dict[str, Any]:
    """Return what explanations say of a message."""
    plain = model.plain.messages[name]
    formula = plain.formula if plain.varies else f"always {plain.formula}"
    return {
        "means": {"length": formula, "id": named(plain)},
        "lengths": describe_range(plain.lengths),
        "facts": [*facts(model.plain, plain, b"")],
        "documented": [
            {"hex": example["hex"], "text": example_in_words(example)}
            for example in plain.said["examples"]
        ],
    }


def _envelope(frame: Envelope) -> dict[str, Any]:
    """Return an envelope; `ids` identify a message together, those not sent among them."""
    return {
        "name": frame.name,
        "header": list(frame.header),
        "begins": sorted(frame.first_bytes) if len(frame.first_bytes) < _ANY_BYTE else [],
        "least": frame.least,
        "uncounted": frame.uncounted,
        "proves": frame.proves_unknown,
        "slots": [_slot(slot, frame) for slot in frame.slots],
        "ids": [_slot(slot) for slot in frame.ids],
    }


def _message(message: MessageLayout) -> dict[str, Any]:
    rule = message.formula
    sizes = (
        [size + message.frame.uncounted for size in rule.sizes] if isinstance(rule, Sizes) else []
    )
    return {
        "name": message.name,
        "page": message_page(message.name),
        "frame": message.frame.name,
        "ids": list(message.ids),
        "direction": message.direction.key,
        "summary": message.message.summary,
        "example": _example(message),
        "fields": [_slot(slot) for slot in message.body],
        "given": [slot.name for slot in message.arguments],
        "counts": {"low": message.counts[0], "high": message.counts[-1]},
        "size": message.size_at(0),
        **({"sizes": sizes} if sizes else {}),
    }


def _example(message: MessageLayout) -> dict[str, Any]:
    """Return values to begin with: those of the first example, or else the lowest."""
    said = message.message.examples[0].values if message.message.examples else {}
    return {
        slot.name: _exact(slot, said[slot.name] if slot.name in said else _lowest(slot))
        for slot in message.arguments
    }


def _lowest(slot: Field) -> Any:
    match slot:
        case Number():
            return 0 if slot.is_float else slot.low
        case Text():
            return ""
        case Packed():
            return [slot.low] * slot.count
        case Items():
            return "" if slot.text else []


def _exact(slot: Field, value: Any) -> Any:
    """Return a value as a browser has it."""
    match slot:
        case Number() if slot.size > _EXACT and not slot.is_float and value is not None:
            return str(value)
        case Items() if slot.element is None and not slot.text:
            return [_exact(field, each) for each in value for field in slot.fields]
        case Items() if slot.element is not None:
            return [
                {field.name: _exact(field, each[field.name]) for field in slot.fields}
                for each in value
            ]
        case Packed() if slot.number_type.bits > 8 * _EXACT:
            return [str(each) for each in value]
        case _:
            return value


def _slot(slot: Slot, frame: Envelope | None = None) -> dict[str, Any]:
    """Return a slot; `at` counts from the first byte of the frame or, below zero, from its end.

    In an element of a list it counts from the first byte of the element.
    """
    placed: dict[str, Any] = {"role": slot.role, "name": slot.name, "at": slot.at}
    if isinstance(slot, Body):
        return placed
    placed["size"] = slot.size
    match slot:
        case Constant():
            placed |= {"bytes": list(slot.data)} | _about(slot.about)
            return placed | ({} if slot.field is None else {"field": True})
        case Text():
            return placed | _about(slot.field.about)
        case Packed():
            return placed | _packed(slot)
        case Number():
            return placed | _number(slot) | _sum(slot, frame)
        case Items():
            return placed | _items(slot)


def _items(items: Items) -> dict[str, Any]:
    count = {"count": items.low} if items.is_fixed else {}
    counter = {} if items.counter is None else {"counter": items.counter.name}
    # Of some lists, any bytes are elements.
    free = {"free": True} if all(map(_holds_anything, items.slots)) else {}
    return {
        **({} if items.element is None else _about(items.field.about)),
        "element": items.element,
        "slots": [_slot(slot) for slot in items.slots],
        **count,
        **counter,
        **({"text": True} if items.text else {}),
        **free,
    }


def _holds_anything(slot: Number | Text | Constant) -> bool:
    if isinstance(slot, Number):
        return slot.is_float or not slot.narrowed
    return slot.role == "reserved"


def _packed(packed: Packed) -> dict[str, Any]:
    bits = packed.number_type.bits
    bounds = _bounds(packed, wide=bits > 8 * _EXACT)
    return {
        "count": packed.count,
        "width": bits,
        "order": packed.order,
        **bounds,
        **_words(packed),
    }


def _sum(number: Number, frame: Envelope | None) -> dict[str, Any]:
    """Return what a length counts; how a checksum is worked out, and from what."""
    if number.role == "length":
        return {"of": list(number.of)}
    if frame is None or number.role != "checksum":
        return {}
    return {
        "method": checksum_method(number),
        "covers": _covers(frame, number),
        "means": f"{number.method} of {listed(number.of)}",
    }


def _number(number: Number) -> dict[str, Any]:
    wide = number.size > _EXACT and not number.is_float
    beyond = sorted(each for each in number.named if not number.low <= each <= number.high)
    return {
        "order": number.order,
        "signed": number.number_type.low < 0,
        **({"float": True} if number.is_float else _bounds(number, wide=wide)),
        **({"beyond": beyond} if beyond else {}),
        **({"optional": True} if number.optional else {}),
        **_words(number),
    }


def _bounds(slot: Number | Packed, *, wide: bool) -> dict[str, Any]:
    if wide:
        return {"wide": True, "low": str(slot.low), "high": str(slot.high)}
    return {"low": slot.low, "high": slot.high}


def _words(slot: Number | Packed) -> dict[str, Any]:
    """Return what a value is called."""
    said, scale = slot.field, slot.field.scale
    offset = {"offset": f"{scale.offset:f}"} if scale and scale.offset else {}
    bits = {name: [each.at.low, each.at.high] for name, each in said.bits.items()}
    wide = isinstance(slot, Number) and slot.size > _EXACT
    meanings = {name: value.about for name, value in said.values.items() if value.about}
    return {
        "unit": said.unit,
        "scale": scale and {"step": f"{scale.step:f}", "unit": scale.unit, **offset},
        "names": {
            name: str(value.value) if wide else value.value for name, value in said.values.items()
        },
        **({"bits": bits} if bits else {}),
        **({"meanings": meanings} if meanings else {}),
        **_about(said.about),
    }


def _about(text: str) -> dict[str, str]:
    return {"about": text} if text else {}


def _covers(frame: Envelope, checksum: Number) -> list[Any]:
    """Return pieces of a frame, ends at or below zero from its end; and numbers of unsent ids."""
    unsent = {part.name: number for number, part in enumerate(frame.ids) if part in frame.unsent}
    pieces: list[Any] = []
    for name in checksum.of:
        if name in unsent:
            pieces.append(unsent[name])
            continue
        (slot,) = (slot for slot in frame.slots if slot.name == name)
        end = -frame.tail_size if isinstance(slot, Body) else slot.at + slot.size
        if pieces and isinstance(pieces[-1], list) and pieces[-1][1] == slot.at != 0:
            pieces[-1][1] = end
        else:
            pieces.append([slot.at, end])
    return pieces


def checksum_method(checksum: Number) -> dict[str, Any]:
    """Return how a checksum is worked out."""
    width = 8 * checksum.size
    terms = method_terms(checksum.method)
    if terms["kind"] == "crc" and width > 8 * _EXACT:
        terms |= {name: str(terms[name]) for name in ("poly", "init", "xor_out")}
    return terms | {"width": width}
