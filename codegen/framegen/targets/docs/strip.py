"""Byte strips: a frame as a row of cells, each some bytes that belong together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.explain import explain
from framegen.language.spec import BodyPart, ConstantPart, IdPart, LengthPart
from framegen.language.values import to_hex
from framegen.model.layout import part_size

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.explain import Row
    from framegen.language.spec import FramePart
    from framegen.model.layout import MessageLayout, Repeat, WireField
    from framegen.model.model import Model

# More elements of a list than this are not shown one by one.
_MOST_CELLS = 64


@dataclass(frozen=True, slots=True)
class Cell:
    """One cell. `role` is the kind of part, `field` or `count`; `value` may be empty."""

    offset: str
    bytes: str
    name: str
    value: str
    role: str


def frame_strip(model: Model, message: MessageLayout, data: bytes) -> list[Cell]:
    """Cut a legal frame into cells."""
    rows = explain(model, data, [message.direction]).readings[0].rows
    counter = "" if message.repeat is None else message.repeat.counter.name
    return [_cell(model, row, counter) for row in rows[:_MOST_CELLS]]


def _cell(model: Model, row: Row, counter: str) -> Cell:
    part = model.spec.frame.get(row.path) if row.offset < model.frame.body_at else None
    role = "count" if row.path == counter else "field" if part is None else part.is_
    return Cell(str(row.offset), to_hex(row.data), row.path, row.text, role)


def pattern_strip(model: Model, message: MessageLayout) -> list[Cell]:
    """Cut what every frame of a message looks like into cells; a list is shown once."""
    cells = list(_envelope(model, message))
    cells += [
        _pattern(field, "count" if message.counts_with(field) else "field")
        for field in message.numbers
    ]
    repeat = message.repeat
    if repeat is not None:
        for field in repeat.fields:
            name = f"{repeat.name}[i]" + ("" if repeat.element is None else f".{field.name}")
            offset = repeated(repeat, field.offset)
            cells.append(Cell(offset, _dots(field.wire.size), name, field.wire.name, "repeated"))
    return cells


def repeated(repeat: Repeat, offset: int = 0) -> str:
    """Say where something stands in each element: `7 + 3i`."""
    step = "i" if repeat.size == 1 else f"{repeat.size}i"
    return f"{repeat.offset + offset} + {step}"


def _pattern(field: WireField, role: str) -> Cell:
    return Cell(str(field.offset), _dots(field.wire.size), field.name, field.wire.name, role)


def _envelope(model: Model, message: MessageLayout) -> Iterator[Cell]:
    at = 0
    order = model.spec.byte_order
    for name, part in model.spec.frame.items():
        size = part_size(part)
        if isinstance(part, ConstantPart):
            yield Cell(str(at), to_hex(part.bytes_), name, "", part.is_)
        elif isinstance(part, IdPart):
            shown = to_hex(message.id.to_bytes(size, order))
            yield Cell(str(at), shown, name, str(message.id), part.is_)
        elif isinstance(part, LengthPart):
            fixed = len(message.lengths) == 1
            shown = to_hex(message.lengths[0].to_bytes(size, order)) if fixed else _dots(size)
            yield Cell(str(at), shown, name, str(message.formula), part.is_)
        at += size


def parts_strip(parts: dict[str, FramePart]) -> list[Cell]:
    """Cut an envelope into cells: which part stands where, whatever the message."""
    cells: list[Cell] = []
    at: int | None = 0
    for name, part in parts.items():
        size = part_size(part)
        shown = to_hex(part.bytes_) if isinstance(part, ConstantPart) else _dots(size) or "…"
        cells.append(Cell("end" if at is None else str(at), shown, name, part.is_, part.is_))
        # What follows the body has no place of its own.
        at = None if at is None or isinstance(part, BodyPart) else at + size
    return cells


def given_strip(parts: dict[str, FramePart], data: dict[str, bytes]) -> list[Cell]:
    """Cut a frame whose parts are known into cells."""
    cells: list[Cell] = []
    at = 0
    for name, part in parts.items():
        if data[name]:
            cells.append(Cell(str(at), to_hex(data[name]), name, "", part.is_))
        at += len(data[name])
    return cells


def _dots(size: int) -> str:
    return " ".join(["··"] * size)
