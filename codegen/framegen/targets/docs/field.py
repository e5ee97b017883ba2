"""The table of fields: offset, type, values, meaning and source."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.spec import NumberField
from framegen.model.slots import Items
from framegen.targets.docs.cite import CiteView, Place, cite_view
from framegen.targets.docs.strip import place_in_each

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import ListField
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Number
    from framegen.reading.yamltree import KeyPath


@dataclass(frozen=True, slots=True)
class ValueView:
    """A named value; `cite` is None where its source is the message's."""

    name: str
    value: int
    about: str
    cite: CiteView | None


@dataclass(frozen=True, slots=True)
class NoteView:
    """A further fact about a field, and its source."""

    text: str
    cite: CiteView


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
    notes: list[NoteView]
    beside: list[str]
    cite: CiteView
    place: Place
    derived: bool

    @property
    def anchor(self) -> str:
        """The anchor, stable as long as the field keeps its name."""
        return "field-" + self.path.replace("[i]", "").replace(".", "-")


def field_views(model: Model, message: MessageLayout) -> list[FieldView]:
    """Return every field in the order of the frame; those of an element follow their list."""
    maker = _Maker(model, message)
    views: list[FieldView] = []
    for slot in message.fields:
        if isinstance(slot, Items):
            views.extend(_list_views(maker, slot))
        else:
            views.append(maker.number(slot, slot.name, str(slot.at), ("fields", slot.name)))
    return views


def _list_views(maker: _Maker, items: Items) -> Iterator[FieldView]:
    count = f"{items.low}..{items.high} of them"
    path: KeyPath = ("fields", items.name)
    if items.element is None:
        (field,) = items.fields
        yield maker.number(field, items.path("i", field), place_in_each(items), path, count)
        return
    yield maker.view(
        items.field, items.name, str(items.at), path, f"list of {items.element}", count
    )
    for field in items.fields:
        offset = place_in_each(items, field.at)
        yield maker.number(field, items.path("i", field), offset, (*path, "fields", field.name))


@dataclass(frozen=True, slots=True)
class _Maker:
    model: Model
    message: MessageLayout

    def number(
        self, field: Number, path: str, offset: str, key: KeyPath, count: str = ""
    ) -> FieldView:
        bounds = f"{field.low}..{field.high}" + (f", {count}" if count else "")
        return self.view(
            field.field,
            path,
            offset,
            key,
            field.number_type.name,
            bounds,
            derived=field.role == "count",
        )

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
        spec = self.model.spec
        unit = getattr(field, "unit", "")
        scale = getattr(field, "scale", None)
        values = getattr(field, "values", {})
        return FieldView(
            path=path,
            offset=offset,
            type=type_,
            unit=f"{unit}, one step is {scale}" if scale else unit,
            range=bounds,
            about=field.about,
            values=[
                ValueView(
                    name,
                    value.value,
                    value.about,
                    None if value.cite is None else cite_view(spec, value.cite),
                )
                for name, value in values.items()
            ],
            beside=_beside(path.rpartition(".")[2], field),
            notes=[NoteView(note.text, cite_view(spec, note.cite)) for note in field.notes],
            cite=cite_view(spec, field.cite or self.message.message.cite),
            place=Place(("messages", self.message.name, *key)),
            derived=derived,
        )


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
