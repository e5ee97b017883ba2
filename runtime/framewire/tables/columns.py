"""Frames as columns: every field of a message by name, read for all of its frames at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa

from ..protocol.slots import List, Number, Packed, Text
from .events import UNKNOWN_SENDER
from .places import read_blocks, read_numbers, steps
from .schema import CLOCK, arrow_type

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..protocol.slots import Slot
    from ..recording.layout import Column, Layout
    from .events import Frames, NoiseRuns, Numbers, Seconds
    from .schema import Schemas


def batch_of(schemas: Schemas, layout: Layout, frames: Frames) -> pa.RecordBatch:
    """Return the frames of one message as a record batch."""
    fields = [field_array(layout, frames, column) for column in layout.columns]
    columns = [*event_columns(schemas, frames), *fields]
    return pa.RecordBatch.from_arrays(columns, schema=schemas.of(layout))


def field_array(layout: Layout, frames: Frames, column: Column) -> pa.Array:
    """Return the values of one field, in all frames of its message."""
    return _Column(layout, frames, column).array


def event_columns(schemas: Schemas, events: Frames | NoiseRuns) -> list[pa.Array]:
    """Return what is known of each event, whatever it is."""
    return [
        pa.array(events.offset),
        pa.array(events.size.astype(np.uint32, copy=False)),
        _directions(schemas, events.direction),
        _time(events.time, len(events.offset)),
        _clock(events.clock, len(events.offset)),
    ]


def _directions(schemas: Schemas, numbers: NDArray[np.int8]) -> pa.Array:
    is_unknown = numbers == UNKNOWN_SENDER
    known = pa.array(numbers, mask=is_unknown if is_unknown.any() else None)
    return pa.DictionaryArray.from_arrays(known, schemas.direction_names)


def _time(seconds: Seconds | None, count: int) -> pa.Array:
    return _nulls(count, pa.float64()) if seconds is None else pa.array(seconds, from_pandas=True)


def _clock(seconds: Seconds | None, count: int) -> pa.Array:
    if seconds is None:
        return _nulls(count, CLOCK)
    is_known = ~np.isnan(seconds)
    microseconds = np.where(is_known, seconds * 1e6, 0).round().astype(np.int64)
    return pa.array(microseconds, mask=~is_known).cast(CLOCK)


_made: dict[pa.DataType, pa.Array] = {}


def _nulls(count: int, kind: pa.DataType) -> pa.Array:
    """Return a column without values: a part of one that is made once, as they are all alike."""
    made = _made.get(kind)
    if made is None or len(made) < count:
        made = _made[kind] = pa.nulls(count, kind)
    return made.slice(0, count)


@dataclass(frozen=True, slots=True)
class _Column:
    """One field of many frames of one message."""

    layout: Layout
    frames: Frames
    column: Column

    @property
    def slot(self) -> Slot:
        """What the model says of it."""
        return self.column.slot

    @property
    def array(self) -> pa.Array:
        """Its values."""
        slot = self.slot
        match slot:
            case List():
                return self._text(slot) if slot.text else self._list(slot)
            case Packed():
                return self._packed(slot)
            case Number(optional=True):
                return self._optional(slot)
            case Number() | Text():
                return _values(self.frames.data, self._at(slot.at), slot)
        raise AssertionError(f"{slot.name} is given by nobody")

    def _at(self, at: int) -> Numbers:
        """Return where a slot begins in `data`, of each frame."""
        start = self.frames.start
        return start + at if at >= 0 else start + self.frames.size.astype(np.int64) + at

    def _optional(self, slot: Number) -> pa.Array:
        end = self.frames.size.astype(np.int64) - self.layout.tail_size
        there = slot.at + slot.size <= end
        # What is absent is read from the beginning of its frame, and not shown.
        places = self._at(0) + np.where(there, slot.at, 0)
        places = np.minimum(places, len(self.frames.data) - slot.size)
        return pa.array(read_numbers(self.frames.data, places, slot), mask=~there)

    def _counts(self, items: List) -> Numbers:
        """Return how many elements a list has, in each frame."""
        if items.is_fixed:
            return np.full(len(self.frames.start), items.low)
        described = self.layout.described
        least = described.lengths[0] + described.envelope.uncounted
        sizes = self.frames.size.astype(np.int64)
        return items.low + (sizes - least) // items.size

    def _elements(self, items: List) -> tuple[Numbers, Numbers]:
        """Return where the elements of each frame begin among all, and where each is in `data`."""
        counts = self._counts(items)
        ends = np.concatenate(([0], np.cumsum(counts)))
        before = self._at(items.at) - items.size * ends[:-1]
        places = np.repeat(before, counts)
        places += steps(items.size, len(places))
        return ends, places

    def _list(self, items: List) -> pa.Array:
        ends, places = self._elements(items)
        fields = self.column.fields
        values = [_values(self.frames.data, places + field.at, field) for field in fields]
        kind = arrow_type(self.layout, self.column)
        if pa.types.is_struct(kind.value_type):
            listed: Any = pa.StructArray.from_arrays(values, fields=[*kind.value_type])
        else:
            (listed,) = values
        return pa.ListArray.from_arrays(pa.array(ends.astype(np.int32)), listed, type=kind)

    def _text(self, items: List) -> pa.Array:
        ends, places = self._elements(items)
        return _strings(ends, self.frames.data[places])

    def _packed(self, slot: Packed) -> pa.Array:
        rows = read_blocks(self.frames.data, self._at(slot.at), slot.size)
        little = slot.order == "little"
        unpacked = np.unpackbits(rows, axis=1, bitorder="little" if little else "big")
        weights = 1 << np.arange(slot.bits, dtype=np.int64)
        numbers = unpacked.reshape(len(rows), slot.count, slot.bits)
        numbers = numbers @ (weights if little else weights[::-1])
        kind = arrow_type(self.layout, self.column)
        values = pa.array(numbers.reshape(-1)).cast(kind.value_type)
        ends = pa.array(np.arange(len(rows) + 1, dtype=np.int32) * slot.count)
        return pa.ListArray.from_arrays(ends, values, type=kind)


def _values(data: NDArray[np.uint8], places: Numbers, slot: Number | Text) -> pa.Array:
    """Return the values that begin at some places of `data`."""
    if isinstance(slot, Text):
        return _texts(read_blocks(data, places, slot.size))
    return pa.array(read_numbers(data, places, slot))


def _texts(rows: NDArray[np.uint8]) -> pa.Array:
    """Return the texts in rows of bytes; zeros at their end are no part of them."""
    numbers = np.arange(1, rows.shape[1] + 1)
    sizes = ((rows != 0) * numbers).max(axis=1)
    ends = np.concatenate(([0], np.cumsum(sizes)))
    return _strings(ends, rows[numbers <= sizes[:, np.newaxis]])


def _strings(ends: Numbers, characters: NDArray[np.uint8]) -> pa.Array:
    """Return texts that stand behind each other; each ends where the next begins."""
    parts = pa.py_buffer(ends.astype(np.int32)), pa.py_buffer(characters)
    return pa.Array.from_buffers(pa.string(), len(ends) - 1, [None, *parts])
