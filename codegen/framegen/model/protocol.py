"""The facts of a model, as libraries carry them: all that explanations and references need.

Where the spec says what is not here: positions, comments, and what can be computed from the slots.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any

from framewire.protocol import slots as facts
from framewire.protocol.envelope import Envelope
from framewire.protocol.message import Message
from framewire.protocol.protocol import Lookalike, Protocol
from framewire.protocol.words import (
    Bits,
    Endpoint,
    Erratum,
    Example,
    Limits,
    Link,
    NamedValue,
    Note,
    Reserved,
    Scale,
    Source,
    Unknown,
)

from framegen.language.formula import Formula
from framegen.language.values import to_hex
from framegen.model.checksums import CHECKSUMS, Crc, Fletcher, Sum, Xor
from framegen.model.slots import Body, Constant, Items, Number, Packed, Text

if TYPE_CHECKING:
    from framegen.language import spec as said
    from framegen.language.values import Citation
    from framegen.model.envelope import Envelope as Derived
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import MessageSlot


def protocol_of(model: Model) -> Protocol:
    """Return the facts of a model."""
    spec, protocol, link = model.spec, model.spec.protocol, model.spec.link
    envelopes = {
        name: _envelope(frame, spec.envelopes[name], spec.byte_order)
        for name, frame in model.envelopes.items()
    }
    return Protocol(
        title=protocol.title,
        summary=protocol.summary,
        description=protocol.description,
        notes=_notes(protocol.notes),
        endpoints={
            name: Endpoint(each.about, _notes(each.notes)) for name, each in spec.endpoints.items()
        },
        authority=protocol.authority,
        byte_order=spec.byte_order,
        link=Link(link.baud, link.bits_per_byte),
        directions=tuple(map(str, model.directions)),
        sources={name: Source(each.title, each.kind) for name, each in spec.sources.items()},
        envelopes=envelopes,
        messages={
            name: _message(model, layout, envelopes[layout.frame.name])
            for name, layout in model.messages.items()
        },
        reserved=tuple(map(_reserved, spec.reserved)),
        lookalikes={
            name: _lookalike(each, model.lookalikes[name], spec.byte_order)
            for name, each in spec.lookalikes.items()
        },
        errata=tuple(map(_erratum, spec.errata)),
        unknowns=tuple(
            Unknown(each.concerns.message, concern_in_words(each.concerns), each.what)
            for each in spec.unknowns
        ),
    )


def _message(model: Model, layout: MessageLayout, envelope: Envelope) -> Message:
    message, name = layout.message, layout.name
    return Message(
        name=name,
        envelope=envelope,
        ids=layout.ids,
        frame=message.frame or "",
        direction=str(layout.direction),
        kind=model.kind(name),
        vendor_name=message.vendor_name or "",
        summary=message.summary,
        description=message.description or "",
        notes=_notes(message.notes),
        deprecated=message.deprecated or "",
        since=message.since or "",
        reply=message.reply or "",
        refusal=message.refusal or "",
        failure=message.failure.field if message.failure else "",
        good=message.failure.good if message.failure else 0,
        asks_for=message.asks_for or "",
        reports=tuple(message.reports),
        acknowledged=message.acknowledged or "",
        lasts=message.lasts or "",
        answers=tuple(model.answers.get(name, ())),
        reports_on=tuple(model.reports_on.get(name, ())),
        cite=str(message.cite),
        fields=tuple(_field(slot, model.spec.byte_order) for slot in layout.body),
        legal=tuple(layout.lengths) if layout.optional else (),
        examples=tuple(
            Example(each.title, to_hex(each.hex), _cited(each.cite), each.constructed or "")
            for each in message.examples
        ),
    )


def _reserved(reserved: said.Reserved) -> Reserved:
    ids, way = reserved.id, reserved.direction
    return Reserved(
        id=None if ids is None else str(ids) if ids.one is None else ids.one,
        name=reserved.name or "",
        direction="" if way is None else str(way),
        why=reserved.why,
        cite=_cited(reserved.cite),
    )


def _erratum(erratum: said.Erratum) -> Erratum:
    return Erratum(
        title=erratum.title,
        message=erratum.concerns.message,
        concerns=concern_in_words(erratum.concerns),
        document=claim_in_words(erratum.document),
        bytes=claim_in_words(erratum.bytes_),
        here=erratum.here,
        why=erratum.why,
        cite=str(erratum.cite),
    )


def _lookalike(lookalike: said.Lookalike, frame: Derived, order: str) -> Lookalike:
    parts = lookalike.frame
    return Lookalike(
        title=lookalike.title,
        about=lookalike.about,
        cite=str(lookalike.cite),
        envelope=None if parts is None else _envelope(frame, parts, order),
        commands=lookalike.commands,
        examples=tuple(Example(each.title, to_hex(each.hex)) for each in lookalike.examples),
    )


def _envelope(frame: Derived, parts: said.Frame, order: str) -> Envelope:
    slots = tuple(_part(slot, parts[slot.name].notes, order) for slot in frame.slots)
    unsent = tuple(_number(part, parts[part.name].notes, sent=False) for part in frame.unsent)
    return Envelope(frame.name, slots, unsent)


def _part(slot: Constant | Number | Body, notes: list[said.Note], order: str) -> facts.Slot:
    """Return a slot of an envelope."""
    match slot:
        case Body():
            return facts.Body(name=slot.name, at=slot.at, about=slot.about, notes=_notes(notes))
        case Constant():
            return _constant(slot, notes, order)
        case Number():
            return _number(slot, notes)


def _field(slot: MessageSlot, order: str) -> facts.Field:
    """Return a slot of a message."""
    match slot:
        case Constant() | Number() | Text():
            return _element(slot, order)
        case Packed():
            field = slot.field
            return facts.Packed(
                name=slot.name,
                at=slot.at,
                size=slot.size,
                packed=slot.number_type.name,
                count=slot.count,
                low=slot.low,
                high=slot.high,
                order=slot.order,
                unit=field.unit,
                scale=_scale(field),
                about=field.about,
                notes=_notes(field.notes),
                cite=_cited(field.cite),
            )
        case Items():
            return _list(slot, order)


def _element(slot: Constant | Number | Text, order: str) -> facts.Element:
    """Return a slot of an element, whose place counts from the first byte of the element."""
    match slot:
        case Constant():
            return _constant(slot, [] if slot.field is None else slot.field.notes, order)
        case Number():
            return _number(slot, slot.field.notes)
        case Text():
            return facts.Text(
                name=slot.name,
                at=slot.at,
                size=slot.size,
                charset=slot.charset,
                about=slot.field.about,
                notes=_notes(slot.field.notes),
                cite=_cited(slot.field.cite),
            )


def _constant(slot: Constant, notes: list[said.Note], order: str) -> facts.Constant:
    """Return constant bytes: of the envelope, or of a number of the message, or of several."""
    field = slot.field
    return facts.Constant(
        role=slot.role,
        name=slot.name,
        at=slot.at,
        size=slot.size,
        data=slot.data,
        about=slot.about,
        is_field=field is not None,
        of_type=field.type if field else "",
        order=(field and field.byte_order) or order,
        notes=_notes(notes),
        cite=_cited(field.cite) if field else "",
    )


def _number(number: Number, notes: list[said.Note], *, sent: bool = True) -> facts.Number:
    field, limits = number.field, number.field.limits
    return facts.Number(
        role=number.role,
        name=number.name,
        at=number.at,
        size=number.size,
        type=number.number_type.name,
        low=-inf if number.is_float else number.low,
        high=inf if number.is_float else number.high,
        signed=number.number_type.low < 0,
        order=number.order,
        optional=number.optional,
        of=number.of,
        method=number.method,
        terms=method_terms(number.method) if number.method else {},
        silent=tuple(sorted(number.silent)),
        unit=field.unit,
        scale=_scale(field),
        bits={
            name: Bits(at.low, at.low if at.high is None else at.high, bits.about)
            for name, bits in field.bits.items()
            for at in (bits.at,)
        },
        about=field.about,
        values={name: _value(value) for name, value in field.values.items()},
        limits=None if limits is None else _limits(limits),
        signed_as=field.signed_as or "",
        notes=_notes(notes),
        cite=_cited(field.cite),
        sent=sent,
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


def _limits(limits: said.Limits) -> Limits:
    return Limits(str(limits.usual), {who: str(each) for who, each in limits.others.items()})


def _scale(field: said.NumberField) -> Scale | None:
    scale = field.scale
    if scale is None:
        return None
    return Scale(f"{scale.step:f}", scale.unit, f"{scale.offset:f}" if scale.offset else "")


def _list(items: Items, order: str) -> facts.List:
    counter = "" if items.counter is None else items.counter.name
    field = items.field if items.element is not None else None
    return facts.List(
        name=items.name,
        at=items.at,
        size=items.size,
        low=items.low,
        high=items.high,
        counter=counter,
        is_fixed=items.is_fixed,
        text=items.text or "",
        variable="" if items.variable in (counter, None) else items.variable,
        element=items.element or "",
        # Bare numbers are declared as one with their list: what is said is said of each.
        about=field.about if field else "",
        fields=tuple(_element(slot, order) for slot in items.slots),
        notes=_notes(field.notes) if field else (),
        cite=_cited(field.cite) if field else "",
    )


def _value(value: said.NamedValue) -> NamedValue:
    return NamedValue(value.value, value.about, value.absent, _cited(value.cite))


def _notes(notes: list[said.Note]) -> tuple[Note, ...]:
    return tuple(Note(note.text, str(note.cite)) for note in notes)


def _cited(cite: Citation | None) -> str:
    return "" if cite is None else str(cite)


def concern_in_words(concern: said.Concern) -> str:
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
