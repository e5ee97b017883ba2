"""Byte strips: a frame as a row of cells, each some bytes that belong together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.explain.pattern import pattern
from framewire.explain.slot_bytes import piece
from framewire.explain.words import order_in_words
from framewire.frame.pluralize import pluralize
from framewire.protocol.slots import Constant

from framegen.explain import explain
from framegen.language.values import to_hex

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framewire.explain.explanation import Row
    from framewire.protocol.envelope import Envelope
    from framewire.protocol.message import Message
    from framewire.protocol.places import Placed
    from framewire.protocol.slots import Slot

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# More elements of a list than this are not shown one by one.
_MOST_CELLS = 64
# More bytes of a slot than this are not shown one by one.
_MOST_DOTS = 8


@dataclass(frozen=True, slots=True)
class Cell:
    """One cell. `role` is that of its slot, or `repeated`; `value` may be empty.

    `order` says which byte of a number comes first; it is empty where there is but one.
    """

    offset: str
    bytes: str
    name: str
    value: str
    order: str
    role: str

    @property
    def text(self) -> str:
        """Value and order in one."""
        return ", ".join(filter(None, (self.value, self.order)))


def frame_strip(model: Model, message: MessageLayout, data: bytes) -> list[Cell]:
    """Cut a legal frame into cells."""
    rows = explain(model, data, [message.direction]).readings[0].rows
    return [_cell(row) for row in rows[:_MOST_CELLS]]


def _cell(row: Row) -> Cell:
    return Cell(str(row.offset), to_hex(row.data), row.path, row.text, row.order, row.role)


def pattern_strip(message: Message) -> list[Cell]:
    """Cut the general form of a message's frames into cells; a list is shown once."""
    return [
        Cell(
            part.place,
            _dots(part.size) if part.data is None else to_hex(part.data),
            part.path,
            part.text,
            part.order,
            part.role,
        )
        for part in pattern(message)
    ]


def parts_strip(envelope: Envelope) -> list[Cell]:
    """Cut an envelope into cells, whatever the message."""
    return [
        Cell(
            str(slot.at) if slot.at >= 0 else "end",
            _shown(slot),
            slot.name,
            slot.role,
            order_in_words(slot),
            slot.role,
        )
        for slot in envelope.slots
    ]


def _shown(slot: Slot) -> str:
    if isinstance(slot, Constant):
        return to_hex(slot.data)
    return "…" if slot.role == "body" else _dots(slot.size)


def given_strip(parts: Iterable[Placed], data: bytes) -> list[Cell]:
    """Cut a frame whose parts are known into cells."""
    return [
        Cell(
            str(placed.at),
            to_hex(piece(placed, data)),
            placed.path,
            "",
            order_in_words(placed.slot),
            placed.slot.role,
        )
        for placed in parts
        if placed.size
    ]


def _dots(size: int) -> str:
    if size > _MOST_DOTS:
        return f"·· … ·· ({pluralize(size, 'byte')})"
    return " ".join(["··"] * size)
