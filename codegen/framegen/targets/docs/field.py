"""The table of fields: offset, type, values, meaning and source."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.explain.pattern import place_in_each
from framewire.explain.words import kind_in_words, order_in_words
from framewire.protocol.slots import List

from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import ListField, NumberField
from framegen.model.slots import Constant, Items, Number, Packed, Text
from framegen.targets.docs.cite import CiteView, Place, cite_view
from framegen.targets.docs.notes import NoteView, note_views

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framewire.protocol.slots import Slot

    from framegen.language.number_types import NumberType
    from framegen.language.spec import NamedValue, Spec
    from framegen.language.values import Citation
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


@dataclass(frozen=True, slots=True)
class ValueView:
    """A named value of a field, in decimal and, as wide as its type, in hex.

    `cite` is None for an address whose source the spec does not say.
    """

    path: str
    name: str
    value: int
    hex: str
    about: str
    cite: CiteView | None

    @property
    def anchor(self) -> str:
        """The anchor, stable as long as field and value keep their names."""
        return f"value-{_anchored(self.path)}-{self.name}"


@dataclass(frozen=True, slots=True)
class BitsView:
    """Bits of a number that have a name: `bit 0`, or `bits 1..7`."""

    at: str
    name: str
    about: str


@dataclass(frozen=True, slots=True)
class FieldView:
    """One row of the table. A list of elements has no type of its own."""

    path: str
    offset: str
    type: str
    unit: str
    range: str
    about: str
    values: list[ValueView]
    bits: list[BitsView]
    notes: list[NoteView]
    beside: list[str]
    cite: CiteView
    place: Place
    derived: bool

    @property
    def anchor(self) -> str:
        """The anchor, stable as long as the field keeps its name."""
        return f"field-{_anchored(self.path)}"


def _anchored(path: str) -> str:
    return path.replace("[i]", "").replace(".", "-")


def field_views(model: Model, message: MessageLayout) -> list[FieldView]:
    """Return every field in the order of the frame; those of an element follow their list."""
    maker = _Maker(model, message)
    views: list[FieldView] = []
    for slot, said in zip(message.body, model.protocol.messages[message.name].fields, strict=True):
        if isinstance(slot, Items) and isinstance(said, List):
            views.extend(_list_views(maker, slot, said))
        elif not isinstance(slot, Items):
            path = ("fields", slot.name)
            views.append(maker.single(slot, said, slot.name, str(slot.at), path))
    return views


def _list_views(maker: _Maker, items: Items, said: List) -> Iterator[FieldView]:
    what = "characters" if items.text else "of them"
    count = f"{items.low if items.is_fixed else f'{items.low}..{items.high}'} {what}"
    path: KeyPath = ("fields", items.name)
    if items.element is None:
        (slot,) = items.slots
        name = items.name if items.text else items.path("i", slot)
        (each,) = said.fields
        yield maker.single(slot, each, name, place_in_each(said), path, count)
        return
    yield maker.view(
        items.field, items.name, str(items.at), path, f"list of {items.element}", count
    )
    for slot, each in zip(items.slots, said.fields, strict=True):
        offset = place_in_each(said, slot.at)
        yield maker.single(slot, each, items.path("i", slot), offset, (*path, "fields", slot.name))


def _range(slot: Number | Text | Packed | Constant, count: str) -> str:
    """Return the values that a slot can have, in words."""
    match slot:
        case Constant():
            always = None if slot.field is None else slot.field.always
            return "anything" if always is None else f"always {always}"
        case Text():
            return f"up to {slot.size} characters"
        case Number() if slot.field.text:
            return count
        case Number() if slot.is_float:
            bounds = "any number"
        case _:
            bounds = f"{slot.low}..{slot.high}"
    return f"{bounds}, {count}" if count else bounds


def _counted(message: MessageLayout, slot: object) -> str:
    """Return what a count can be on the wire: what its list can have, and no more."""
    lists = (each for each in message.body if isinstance(each, Items) and slot in each.counters)
    for items in lists:
        counter = next(each for each in items.counters if each is slot or each == slot)
        low, high = items.counted(counter, items.low), items.counted(counter, items.high)
        return f"always {low}" if low == high else f"{low}..{high}"
    return ""


@dataclass(frozen=True, slots=True)
class _Maker:
    model: Model
    message: MessageLayout

    def single(
        self,
        slot: Number | Text | Packed | Constant,
        said: Slot,
        path: str,
        offset: str,
        key: KeyPath,
        count: str = "",
    ) -> FieldView:
        """Return the row of a slot that is no list, or of the numbers in one."""
        if slot.field is None:
            raise AssertionError(f"{slot.name} is no field")
        derived = isinstance(slot, Number) and slot.counts
        bounds = _counted(self.message, slot) or _range(slot, count)
        is_text = isinstance(slot, Number) and slot.field.text
        words = ("text",) if is_text else (kind_in_words(said), order_in_words(said))
        type_ = ", ".join(filter(None, words))
        return self.view(slot.field, path, offset, key, type_, bounds, derived=derived)

    def view(
        self,
        field: NumberField | ListField,
        path: str,
        offset: str,
        key: KeyPath,
        type_: str,
        bounds: str,
        *,
        derived: bool = False,
    ) -> FieldView:
        """Return the row of a field."""
        spec = self.model.spec
        values = getattr(field, "values", {})
        source = field.cite or self.message.message.cite
        return FieldView(
            path=path,
            offset=offset,
            type=type_,
            unit=_unit(field),
            range=bounds,
            about=field.about,
            values=_values(
                spec, path, values, NUMBER_TYPES.get(getattr(field, "type", "")), source
            ),
            beside=[*_on_the_wire(field), *_beside(path.rpartition(".")[2], field)],
            bits=_bits(field),
            notes=note_views(spec, field.notes),
            cite=cite_view(spec, source),
            place=Place(("messages", self.message.name, *key)),
            derived=derived,
        )


def address_values(model: Model, message: MessageLayout) -> list[ValueView]:
    """Return the addresses that have a name."""
    address = message.frame.address
    if address is None:
        return []
    values = address.field.values
    return _values(model.spec, address.name, values, address.number_type, None)


def _values(
    spec: Spec,
    path: str,
    values: Mapping[str, NamedValue],
    type_: NumberType | None,
    around: Citation | None,
) -> list[ValueView]:
    """Return named values; those without a source have that of what is around them."""
    cites = [value.cite or around for value in values.values()]
    return [
        ValueView(
            path,
            name,
            value.value,
            _in_hex(value.value, type_),
            value.about,
            None if cite is None else cite_view(spec, cite),
        )
        for (name, value), cite in zip(values.items(), cites, strict=True)
    ]


def _in_hex(number: int, type_: NumberType | None) -> str:
    """Return a number as the bytes of its type have it; nothing where these are not whole."""
    if type_ is None or type_.is_float:
        return ""
    return f"0x{number % (1 << 8 * type_.size):0{2 * type_.size}X}"


def _unit(field: NumberField | ListField) -> str:
    """Return the unit of a value, and what a step of it is in a larger one."""
    if isinstance(field, ListField) or field.scale is None:
        return getattr(field, "unit", "")
    step, unit, offset = field.scale.step, field.scale.unit, field.scale.offset
    scaled = f"one step is {step:f} {unit}".rstrip()
    scaled += f", and 0 is {offset:f} {unit}".rstrip() if offset else ""
    return f"{field.unit}, {scaled}" if field.unit else scaled


def _bits(field: NumberField | ListField) -> list[BitsView]:
    if isinstance(field, ListField):
        return []
    return [
        BitsView(f"bit {at.low}" if at.low == at.high else f"bits {at}", name, each.about)
        for name, each in field.bits.items()
        for at in (each.at,)
    ]


def _on_the_wire(field: NumberField | ListField) -> Iterator[str]:
    """Say what its bytes are, where that is not as usual."""
    if isinstance(field, ListField):
        return
    if field.always is not None:
        yield "Never given."
    if field.reserved is not None:
        yield f"Reserved: written as {field.reserved}, read as anything, and never given."
    if field.optional:
        yield "May be absent, with all that is behind it."


def _beside(name: str, field: NumberField | ListField) -> list[str]:
    """Say what the library offers for a number besides the number itself."""
    if not isinstance(field, NumberField):
        return []
    found: list[str] = []
    if field.limits is not None:
        others = [f"{who} take {range_}" for who, range_ in field.limits.others.items()]
        limits = "; ".join(["unless told otherwise", *others])
        found.append(f"A client sends {field.limits.usual} {limits}.")
    if field.signed_as is not None:
        found.append(f"The property signed_{name} has it as {field.signed_as}.")
    marked = [str(value.value) for value in field.values.values() if value.absent]
    if marked:
        found.append(f"At {' or '.join(marked)} the property absent is true.")
    return found
