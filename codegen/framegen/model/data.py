"""The model as plain data, such as JSON has: all that explanations and reference pages need.

Positions, comments and what can be computed from the slots are left out, and so is what is empty.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.language.formula import Formula
from framegen.language.values import to_hex
from framegen.model.checksums import CHECKSUMS, Crc, Fletcher, Sum, Xor
from framegen.model.slots import Body, Constant, Items, Number, Packed, Text

if TYPE_CHECKING:
    from framegen.language.spec import (
        Concern,
        Example,
        Frame,
        ListField,
        Lookalike,
        NamedValue,
        Note,
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
        **_filled(
            notes=_notes(protocol.notes),
            endpoints={
                name: {"about": each.about, **_filled(notes=_notes(each.notes))}
                for name, each in spec.endpoints.items()
            },
        ),
        "authority": protocol.authority,
        "byte_order": spec.byte_order,
        "link": {"baud": link.baud, "bits_per_byte": link.bits_per_byte},
        "directions": [str(way) for way in model.directions],
        "sources": {
            name: {"title": source.title, "kind": source.kind}
            for name, source in spec.sources.items()
        },
        **_frames(model),
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


def _frames(model: Model) -> dict[str, Any]:
    """Return the only envelope, or all of them by name."""
    found = {
        name: _envelope(frame, model.spec.envelopes[name])
        for name, frame in model.envelopes.items()
    }
    return {"frames": found} if model.spec.frames else {"frame": found["frame"]}


def _message(model: Model, layout: MessageLayout) -> dict[str, Any]:
    message, name = layout.message, layout.name
    return (
        _ids(layout)
        | _filled(
            frame=message.frame,
            direction=str(layout.direction),
            kind=model.kind(name),
            vendor_name=message.vendor_name,
            summary=message.summary,
            description=message.description,
            notes=_notes(message.notes),
            deprecated=message.deprecated,
            since=message.since,
            reply=message.reply,
            refusal=message.refusal,
            failure=message.failure and message.failure.field,
            good=message.failure and message.failure.good,
            asks_for=message.asks_for,
            reports=message.reports,
            acknowledged=message.acknowledged,
            lasts=message.lasts,
            answers=model.answers.get(name),
            reports_on=model.reports_on.get(name),
            cite=str(message.cite),
        )
        | {
            "fields": [_slot(slot) for slot in layout.body],
            **({"lengths": list(layout.lengths)} if layout.optional else {}),
            "examples": [_example(each) for each in message.examples],
        }
    )


def _ids(layout: MessageLayout) -> dict[str, Any]:
    """Return the id of a message, or its ids where its frame has several, or none."""
    if len(layout.ids) == 1:
        return {"id": layout.ids[0]}
    return {"ids": list(layout.ids)} if layout.ids else {}


def _example(example: Example) -> dict[str, Any]:
    cite = None if example.cite is None else str(example.cite)
    return _filled(
        title=example.title, hex=to_hex(example.hex), cite=cite, constructed=example.constructed
    )


def _reserved(reserved: Reserved) -> dict[str, Any]:
    ids = reserved.id
    given = {} if ids is None else {"id": str(ids) if ids.one is None else ids.one}
    way = None if reserved.direction is None else str(reserved.direction)
    cite = None if reserved.cite is None else str(reserved.cite)
    return given | _filled(name=reserved.name, direction=way, why=reserved.why, cite=cite)


def _lookalike(lookalike: Lookalike, frame: Envelope) -> dict[str, Any]:
    own = {"frame": _envelope(frame, lookalike.frame)} if lookalike.frame else {}
    return {
        "title": lookalike.title,
        "about": lookalike.about,
        "cite": str(lookalike.cite),
        **own,
        "commands": {str(number): meaning for number, meaning in lookalike.commands.items()},
        "examples": [{"title": each.title, "hex": to_hex(each.hex)} for each in lookalike.examples],
    }


def _envelope(frame: Envelope, parts: Frame) -> list[dict[str, Any]]:
    hidden = [{**_slot(slot), "sent": False} for slot in frame.unsent]
    return [
        each | _filled(notes=_notes(parts[each["name"]].notes))
        for each in (*(_slot(slot) for slot in frame.slots), *hidden)
    ]


def _slot(slot: Slot) -> dict[str, Any]:
    """Return a slot; in an element of a list, its place counts from the element's first byte."""
    said: dict[str, Any] = {"role": slot.role, "name": slot.name, "at": slot.at}
    match slot:
        case Body():
            return said | {"size": 0} | _filled(about=slot.about)
        case Constant():
            said |= {"size": slot.size, "bytes": to_hex(slot.data)} | _filled(about=slot.about)
            return said if slot.field is None else said | _constant(slot.field)
        case Number():
            return said | _number(slot)
        case Text():
            said |= {"size": slot.size, "charset": slot.charset}
            return said | _filled(about=slot.field.about) | _evidence(slot.field)
        case Packed():
            return said | _packed(slot)
        case Items():
            return said | _items(slot)


def _constant(field: NumberField) -> dict[str, Any]:
    """Return what is known of constant bytes of a message: those of a number, or of several."""
    order = _filled(byte_order=field.byte_order)
    return {"field": True, "of_type": field.type} | order | _evidence(field)


def _number(number: Number) -> dict[str, Any]:
    field, limits = number.field, number.field.limits
    bounds: dict[str, Any] = {"size": number.size, "type": number.number_type.name}
    if not number.is_float:
        bounds |= {"low": number.low, "high": number.high}
    return bounds | _filled(
        signed=number.number_type.low < 0,
        byte_order=field.byte_order,
        optional=number.optional,
        of=list(number.of),
        method=number.method,
        terms=method_terms(number.method) if number.method else {},
        silent=sorted(number.silent),
        unit=field.unit,
        scale=_scale(field),
        bits={name: [bits.at.low, bits.at.high, bits.about] for name, bits in field.bits.items()},
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


def method_terms(name: str) -> dict[str, Any]:
    """Return how a checksum of a method is worked out."""
    method = CHECKSUMS[name]
    match method:
        case Crc():
            terms = {"poly": method.poly, "init": method.init, "reflected": method.reflected}
            mixed = {"mixed": True} if method.mixed else {}
            return {"kind": "crc", **terms, "xor_out": method.xor_out, **mixed}
        case Sum():
            how = {"left_out": method.left_out, "word": method.word, "carried": method.carried}
            apart = _other_than(how, {"left_out": 0, "word": 1, "carried": False})
            return {"kind": "sum", "factor": method.factor, "offset": method.offset, **apart}
        case Xor():
            how = {"mask": method.mask, "word": method.word}
            apart = _other_than(how, {"mask": 0xFF, "word": 1})
            return {"kind": "xor", "xor_out": method.xor_out, **apart}
        case Fletcher():
            return {"kind": "fletcher", "modulus": method.modulus, "start": method.start}
    raise AssertionError(f"nothing explains {name}")


def _other_than(terms: dict[str, Any], usual: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in terms.items() if value != usual[name]}


def _scale(field: NumberField) -> list[str]:
    if field.scale is None:
        return []
    offset = [f"{field.scale.offset:f}"] if field.scale.offset else []
    return [f"{field.scale.step:f}", field.scale.unit, *offset]


def _packed(packed: Packed) -> dict[str, Any]:
    field = packed.field
    bounds = {"size": packed.size, "packed": packed.number_type.name, "count": packed.count}
    bounds |= {"low": packed.low, "high": packed.high}
    return bounds | _filled(
        byte_order=field.byte_order,
        unit=field.unit,
        scale=_scale(field),
        about=field.about,
        **_evidence(field),
    )


def _items(items: Items) -> dict[str, Any]:
    said: dict[str, Any] = {"size": items.size, "low": items.low, "high": items.high}
    if items.counter is not None:
        said["counter"] = items.counter.name
    named = None if items.counter is None else items.counter.name
    said |= _filled(fixed=items.is_fixed, text=items.text)
    said |= {} if items.variable == named else _filled(variable=items.variable)
    fields = {"fields": [_slot(slot) for slot in items.slots]}
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
    cite = None if field.cite is None else str(field.cite)
    return _filled(notes=_notes(field.notes), cite=cite)


def _notes(notes: list[Note]) -> list[dict[str, str]]:
    return [{"text": note.text, "cite": str(note.cite)} for note in notes]


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
