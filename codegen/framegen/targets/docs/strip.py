"""Byte strips: a frame as a row of cells, each some bytes that belong together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.explain import explain
from framegen.language.values import to_hex
from framegen.model.slots import Body, Constant, Items, Number, Packed, Text
from framegen.pluralize import pluralize

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.explanation.explanation import Row
    from framegen.explanation.protocol import Placed
    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Slot

# More elements of a list than this are not shown one by one.
_MOST_CELLS = 64
# More bytes of a slot than this are not shown one by one.
_MOST_DOTS = 8


@dataclass(frozen=True, slots=True)
class Cell:
    """One cell. `role` is that of its slot, or `repeated`; `value` may be empty."""

    offset: str
    bytes: str
    name: str
    value: str
    role: str


def frame_strip(model: Model, message: MessageLayout, data: bytes) -> list[Cell]:
    """Cut a legal frame into cells."""
    rows = explain(model, data, [message.direction]).readings[0].rows
    return [_cell(row) for row in rows[:_MOST_CELLS]]


def _cell(row: Row) -> Cell:
    return Cell(str(row.offset), to_hex(row.data), row.path, row.text, row.role)


def pattern_strip(message: MessageLayout) -> list[Cell]:
    """Cut the general form of a message's frames into cells; a list is shown once."""
    cells: list[Cell] = []
    for slot in message.slots:
        if isinstance(slot, Items):
            cells += [_in_each(slot, each) for each in slot.slots]
        else:
            cells.append(Cell(_place(slot), *_pattern(message, slot), slot.role))
    return cells


def _pattern(
    message: MessageLayout, slot: Constant | Number | Text | Packed
) -> tuple[str, str, str]:
    """Return the bytes of a slot as far as they are known, its name, and its value or its type."""
    match slot:
        case Constant():
            return to_hex(slot.data), slot.name, "reserved" if slot.role == "reserved" else ""
        case Number(role="id"):
            number = message.id_of(slot)
            return to_hex(slot.write(number)), slot.name, str(number)
        case Number(role="length"):
            fixed = len(message.lengths) == 1
            data = to_hex(slot.write(message.lengths[0])) if fixed else _dots(slot.size)
            return data, slot.name, str(message.formula)
        case _:
            return _dots(slot.size), slot.name, _kind(slot)


def _kind(slot: Number | Text | Packed) -> str:
    """Return what a slot holds: its type, or the method of a checksum."""
    match slot:
        case Number(role="checksum"):
            return slot.method
        case Number():
            return (
                f"{slot.number_type.name}, may be absent"
                if slot.optional
                else slot.number_type.name
            )
        case Packed():
            return f"{slot.count} of {slot.number_type.name}"
        case Text():
            return "text"


def _in_each(items: Items, slot: Number | Text | Constant) -> Cell:
    path, offset = items.path("i", slot), place_in_each(items, slot.at)
    if items.text:
        return Cell(offset, _dots(1), items.name, "text", "repeated")
    if isinstance(slot, Constant):
        value = "reserved" if slot.role == "reserved" else ""
        return Cell(offset, to_hex(slot.data), path, value, "repeated")
    return Cell(offset, _dots(slot.size), path, _kind(slot), "repeated")


def place_in_each(items: Items, at: int = 0) -> str:
    """Return the offset of a number in each element of a list: `7 + 3i`."""
    step = "i" if items.size == 1 else f"{items.size}i"
    return f"{items.at + at} + {step}"


def parts_strip(envelope: Envelope) -> list[Cell]:
    """Cut an envelope into cells, whatever the message."""
    return [
        Cell(_place(slot), _shown(slot), slot.name, slot.role, slot.role) for slot in envelope.slots
    ]


def _shown(slot: Slot) -> str:
    match slot:
        case Constant():
            return to_hex(slot.data)
        case Body():
            return "…"
        case _:
            return _dots(slot.size)


def _place(slot: Slot) -> str:
    """Return the offset of a slot; `end` for one behind the fields."""
    return str(slot.at) if slot.at >= 0 else "end"


def given_strip(parts: Iterable[Placed], data: bytes) -> list[Cell]:
    """Cut a frame whose parts are known into cells."""
    return [
        Cell(str(placed.at), to_hex(placed.of(data)), placed.path, "", placed.slot.role)
        for placed in parts
        if placed.size
    ]


def _dots(size: int) -> str:
    if size > _MOST_DOTS:
        return f"·· … ·· ({pluralize(size, 'byte')})"
    return " ".join(["··"] * size)
