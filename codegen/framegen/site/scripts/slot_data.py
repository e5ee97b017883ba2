"""The slots of a protocol as data for scripts, with what explains them.

Numbers of eight bytes are written as text: those of JSON in a browser have fewer digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framewire.explain.words import listed

from framegen.model.protocol import method_terms
from framegen.model.slots import Body, Constant, Items, Number, Packed, Text

if TYPE_CHECKING:
    from framegen.model.envelope import Envelope
    from framegen.model.slots import Field, Slot

# Numbers of so many bytes are exact in a browser.
_EXACT = 6


def is_wide(slot: Number | Packed) -> bool:
    """Tell whether its numbers may have more digits than those of a browser."""
    if isinstance(slot, Packed):
        return slot.number_type.bits > 8 * _EXACT
    return slot.size > _EXACT and not slot.is_float


def lowest(slot: Field) -> Any:
    """Return the lowest value of a field."""
    match slot:
        case Number():
            return 0 if slot.is_float else slot.low
        case Text():
            return ""
        case Packed():
            return [slot.low] * slot.count
        case Items():
            return "" if slot.text else []


def exact(slot: Field, value: Any) -> Any:
    """Return a value as a browser has it."""
    match slot:
        case Number() if is_wide(slot) and value is not None:
            return str(value)
        case Items() if slot.element is None and not slot.text:
            return [exact(field, each) for each in value for field in slot.fields]
        case Items() if slot.element is not None:
            return [
                {field.name: exact(field, each[field.name]) for field in slot.fields}
                for each in value
            ]
        case Packed() if is_wide(slot):
            return [str(each) for each in value]
        case _:
            return value


def slot_data(slot: Slot, frame: Envelope | None = None) -> dict[str, Any]:
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
        "slots": [slot_data(slot) for slot in items.slots],
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
    bounds = _bounds(packed, wide=is_wide(packed))
    return {
        "count": packed.count,
        "width": packed.number_type.bits,
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
    wide = is_wide(number)
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
    wide = isinstance(slot, Number) and is_wide(slot)
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
