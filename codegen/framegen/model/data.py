"""The model as plain data, such as JSON has: all that explanations and reference pages need.

Positions, comments and what can be computed from the slots are left out, and so is what is empty.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.language.formula import Formula
from framegen.language.values import to_hex
from framegen.model.slots import Body, Constant, Items, Number

if TYPE_CHECKING:
    from framegen.language.spec import (
        Concern,
        Example,
        ListField,
        Lookalike,
        NamedValue,
        NumberField,
        Reserved,
    )
    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Slot


def model_data(model: Model) -> dict[str, Any]:
    """Return the model as data."""
    spec, protocol, link = model.spec, model.spec.protocol, model.spec.link
    return {
        "title": protocol.title,
        "summary": protocol.summary,
        "description": protocol.description,
        "authority": protocol.authority,
        "byte_order": spec.byte_order,
        "link": {"baud": link.baud, "bits_per_byte": link.bits_per_byte},
        "directions": [str(way) for way in model.directions],
        "sources": {
            name: {"title": source.title, "kind": source.kind}
            for name, source in spec.sources.items()
        },
        "frame": _envelope(model.frame),
        "messages": {name: _message(model, layout) for name, layout in model.messages.items()},
        "reserved": [_reserved(each) for each in spec.reserved],
        "lookalikes": {
            name: _lookalike(each, model.lookalikes[name]) for name, each in spec.lookalikes.items()
        },
        "errata": [
            {
                "title": each.title,
                "message": each.concerns.message,
                "concerns": concern_in_words(each.concerns),
                "document": claim_in_words(each.document),
                "bytes": claim_in_words(each.bytes_),
                "here": each.here,
                "why": each.why,
                "cite": str(each.cite),
            }
            for each in spec.errata
        ],
        "unknowns": [
            {
                "message": each.concerns.message,
                "concerns": concern_in_words(each.concerns),
                "what": each.what,
            }
            for each in spec.unknowns
        ],
    }


def _message(model: Model, layout: MessageLayout) -> dict[str, Any]:
    message, name = layout.message, layout.name
    return _filled(
        id=layout.id,
        direction=str(layout.direction),
        kind=model.kind(name),
        vendor_name=message.vendor_name,
        summary=message.summary,
        description=message.description,
        deprecated=message.deprecated,
        since=message.since,
        reply=message.reply,
        reports=message.reports,
        acknowledged=message.acknowledged,
        lasts=message.lasts,
        answers=model.answers.get(name),
        reports_on=model.reports_on.get(name),
        cite=str(message.cite),
    ) | {
        "fields": [_slot(slot) for slot in layout.fields],
        "examples": [_example(each) for each in message.examples],
    }


def _example(example: Example) -> dict[str, Any]:
    cite = None if example.cite is None else str(example.cite)
    return _filled(
        title=example.title, hex=to_hex(example.hex), cite=cite, constructed=example.constructed
    )


def _reserved(reserved: Reserved) -> dict[str, Any]:
    given = {} if reserved.id is None else {"id": reserved.id}
    way = None if reserved.direction is None else str(reserved.direction)
    cite = None if reserved.cite is None else str(reserved.cite)
    return given | _filled(name=reserved.name, direction=way, why=reserved.why, cite=cite)


def _lookalike(lookalike: Lookalike, frame: Envelope) -> dict[str, Any]:
    own = {"frame": _envelope(frame)} if lookalike.frame else {}
    return {
        "title": lookalike.title,
        "about": lookalike.about,
        "cite": str(lookalike.cite),
        **own,
        "commands": {str(number): meaning for number, meaning in lookalike.commands.items()},
        "examples": [{"title": each.title, "hex": to_hex(each.hex)} for each in lookalike.examples],
    }


def _envelope(frame: Envelope) -> list[dict[str, Any]]:
    return [_slot(slot) for slot in frame.slots]


def _slot(slot: Slot) -> dict[str, Any]:
    """Return a slot; in an element of a list, its place counts from the element's first byte."""
    said: dict[str, Any] = {"role": slot.role, "name": slot.name, "at": slot.at}
    match slot:
        case Body():
            return said | {"size": 0} | _filled(about=slot.about)
        case Constant():
            return (
                said | {"size": slot.size, "bytes": to_hex(slot.data)} | _filled(about=slot.about)
            )
        case Number():
            return said | _number(slot)
        case Items():
            return said | _items(slot)


def _number(number: Number) -> dict[str, Any]:
    field, limits = number.field, number.field.limits
    bounds = {"size": number.size, "type": number.number_type.name}
    bounds |= {"low": number.low, "high": number.high}
    return bounds | _filled(
        signed=number.number_type.low < 0,
        of=list(number.of),
        unit=field.unit,
        scale=field.scale and [str(field.scale.step), field.scale.unit],
        about=field.about,
        values={name: _value(value) for name, value in field.values.items()},
        limits=limits
        and {
            "usual": str(limits.usual),
            "others": {who: str(bound) for who, bound in limits.others.items()},
        },
        signed_as=field.signed_as,
        **_evidence(field),
    )


def _items(items: Items) -> dict[str, Any]:
    said = {"size": items.size, "low": items.low, "high": items.high, "counter": items.counter.name}
    fields = {"fields": [_slot(field) for field in items.fields]}
    if items.element is None:  # the list and its numbers are declared as one
        return said | fields
    return (
        said
        | {"element": items.element}
        | _filled(about=items.field.about)
        | fields
        | _evidence(items.field)
    )


def _value(value: NamedValue) -> dict[str, Any]:
    cite = None if value.cite is None else str(value.cite)
    said = _filled(about=value.about, absent=value.absent, cite=cite)
    return {"value": value.value, **said}


def _evidence(field: NumberField | ListField) -> dict[str, Any]:
    """Return what else is known of a field, and from where."""
    notes = [{"text": note.text, "cite": str(note.cite)} for note in field.notes]
    return _filled(notes=notes, cite=None if field.cite is None else str(field.cite))


def _filled(**said: Any) -> dict[str, Any]:
    """Return what is said, without what is empty."""
    return {name: value for name, value in said.items() if value}


def concern_in_words(concern: Concern) -> str:
    """Name the fact of the message that is meant."""
    words = [] if concern.fact is None else [f"its {concern.fact}"]
    if concern.parameter is not None:
        words.append(f"parameter {concern.parameter}")
    if concern.field is not None:
        words.append(concern.field)
    if concern.example is not None:
        words.append(f"in example {concern.example}" if words else f"example {concern.example}")
    return " ".join(words)


def claim_in_words(value: Any) -> str:
    """Write what a document or its bytes say of a fact."""
    if value is None:
        return "nothing"
    if isinstance(value, list):
        return ", ".join(claim_in_words(item) for item in value)
    return str(value) if not isinstance(value, Formula) else f"length {value}"
