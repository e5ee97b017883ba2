"""A capture as one Arrow file: all of its events in order, a column of structs for each message."""

from __future__ import annotations

import errno
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

from ...recording.layout import EVENT_COLUMNS, NOISE, PARAMETERS, layouts_of
from ..reader import BLOCK, events
from ..schema import REASON_NAMES
from ..source import opened
from .write_error import naming

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Sequence

    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.direction import Direction
    from ..events import Numbers
    from ..reader import Batches
    from ..schema import Schemas
    from ..source import Source

_MAGIC = b"ARROW1"

UNKNOWN = "unknown"
"""The name of unknown frames: their column, and what `event` says of them."""


class EventRows:
    """Events as rows of one table, for a capture that has some tables."""

    def __init__(self, schemas: Schemas, names: Iterable[str]) -> None:
        there = set(names)
        self._every = schemas.every()
        every = [name for name in self._every if name in there and name != NOISE]
        self._events = pa.array([*every, NOISE, UNKNOWN], pa.string())
        # Of a message without fields, `event` says all.
        self._messages = [name for name in every if _fields(self._every[name])]
        self._has_noise = NOISE in there
        numbers = [column for column, _ in schemas.unknown_numbers.values()]
        self._of_unknown = [*numbers, PARAMETERS]

    @cached_property
    def schema(self) -> pa.Schema:
        """The schema: what is known of every event, which it is, and its fields."""
        every = self._every
        noise = every[NOISE]
        columns = [noise.field(name) for name in EVENT_COLUMNS]
        event = pa.dictionary(pa.int16(), pa.string())
        about = {"about": "The name of the message, noise, or unknown."}
        columns += [pa.field("event", event, metadata=about), noise.field("reason")]
        for name in self._messages:
            said = {b"about": every[name].metadata[b"summary"]}
            columns.append(pa.field(name, pa.struct(_fields(every[name])), metadata=said))
        if self._has_noise:
            of_unknown = pa.struct([noise.field(name) for name in self._of_unknown])
            columns.append(pa.field(UNKNOWN, of_unknown))
        protocol = noise.metadata[b"protocol"]
        said = {b"protocol": protocol, b"summary": b"The events of a capture."}
        return pa.schema(columns, metadata=said)

    def of(self, made: Batches) -> pa.RecordBatch:
        """Return the events of one stretch, in the order of the capture."""
        offsets = [batch.column("offset").to_numpy() for batch in made.values()]
        order = np.argsort(np.concatenate(offsets), kind="stable")
        rows = _Rows(made, order)
        columns = [rows.column(name) for name in EVENT_COLUMNS]
        columns += [pa.DictionaryArray.from_arrays(self._event(made, order), self._events)]
        columns += [rows.reasons()]
        columns += [rows.structs(name, self.schema) for name in self._messages]
        if self._has_noise:
            columns.append(rows.unknown(self.schema, self._of_unknown))
        return pa.RecordBatch.from_arrays(columns, schema=self.schema)

    def _event(self, made: Batches, order: Numbers) -> pa.Array:
        """Return which event each row is, an index into the names of events."""
        numbers = {name: at for at, name in enumerate(self._events.to_pylist())}
        parts = []
        for name, batch in made.items():
            event = np.full(batch.num_rows, numbers[name], np.int16)
            if name == NOISE:
                event += batch.column("unknown").to_numpy(zero_copy_only=False)
            parts.append(event)
        return pa.array(np.concatenate(parts)[order])


class _Rows:
    """The rows of some tables, in one order."""

    def __init__(self, made: Batches, order: Numbers) -> None:
        self._made = made
        self._order = pa.array(order)
        # Where each row has gone.
        self._places = np.empty(len(order), np.int64)
        self._places[order] = np.arange(len(order))

    def column(self, name: str) -> pa.Array:
        """Return a column that all of them have."""
        arrays = [batch.column(name) for batch in self._made.values()]
        return pa.concat_arrays(arrays).take(self._order)

    def reasons(self) -> pa.Array:
        """Return the reasons of noise."""
        if NOISE not in self._made:
            nothing = pa.nulls(len(self._order), pa.int8())
            return pa.DictionaryArray.from_arrays(nothing, REASON_NAMES)
        return self._spread(NOISE, self._made[NOISE].column("reason"))

    def structs(self, name: str, schema: pa.Schema) -> pa.Array:
        """Return the fields of a message, and null in the rows of others."""
        kind = schema.field(name).type
        if name not in self._made:
            return pa.nulls(len(self._order), kind)
        batch = self._made[name]
        fields = [*kind]
        values = [batch.column(each.name) for each in fields]
        return self._spread(name, pa.StructArray.from_arrays(values, fields=fields))

    def unknown(self, schema: pa.Schema, names: Sequence[str]) -> pa.Array:
        """Return the numbers and parameters of unknown frames, and null in the rows of others."""
        kind = schema.field(UNKNOWN).type
        if NOISE not in self._made:
            return pa.nulls(len(self._order), kind)
        noise = self._made[NOISE]
        values = [noise.column(name) for name in names]
        absent = pa.array(~noise.column("unknown").to_numpy(zero_copy_only=False))
        frames = pa.StructArray.from_arrays(values, fields=[*kind], mask=absent)
        return self._spread(NOISE, frames)

    def _spread(self, name: str, values: pa.Array) -> pa.Array:
        """Return the values of one table in the rows of all, with null in those of others."""
        begin = 0
        for other, batch in self._made.items():
            if other == name:
                break
            begin += batch.num_rows
        which = np.full(len(self._order), -1, np.int64)
        which[self._places[begin : begin + len(values)]] = np.arange(len(values))
        return values.take(pa.array(which, mask=which < 0))


def _fields(schema: pa.Schema) -> Sequence[pa.Field]:
    """Return the fields of a message."""
    return [each for each in schema if each.name not in EVENT_COLUMNS]


def names_in(
    codec: ProtocolCodec, source: Source, form: str, direction: Direction | None
) -> set[str]:
    """Return the tables that have rows in a capture."""
    every = layouts_of(codec).every
    there: set[str] = set()
    with opened(source, form) as capture:
        for stretch in events(codec, capture, direction, BLOCK):
            there.update(every[kind].name for kind in np.unique(stretch.frames.kind).tolist())
            if stretch.noise.frame:
                there.add(NOISE)
    return there


def arrow_written(
    schemas: Schemas,
    batches: Iterable[Batches],
    file: str | os.PathLike[str],
    names: Iterable[str],
) -> dict[str, int]:
    """Write all events to one Arrow IPC file, and return the rows of each table.

    `names` are the tables that occur, or more. Whatever goes wrong, the file is not half-written.
    """
    target = Path(file)
    part = target.with_name(f"{target.name}.part")
    rows: dict[str, int] = {}
    try:
        with naming(part):
            _write(batches, part, EventRows(schemas, names), rows)
        part.replace(target)
    except BaseException:
        with suppress(OSError):
            part.unlink(missing_ok=True)
        raise
    return rows


def refuse_target(file: str | os.PathLike[str]) -> None:
    """Raise OSError if no Arrow file can be written there, or another file would be lost.

    To be called before anything is read: the capture itself may have been named by mistake.
    """
    target = Path(file)
    if not target.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, f"there is no folder {target.parent}", str(target))
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, "it is a folder: name a file in it", str(target))
    if not target.is_file():
        return
    with target.open("rb") as stream:
        begun = stream.read(len(_MAGIC))
    if begun not in (b"", _MAGIC):
        problem = "it is there, and is no Arrow file: give another name, or remove it"
        raise FileExistsError(errno.EEXIST, problem, str(target))


def _write(batches: Iterable[Batches], path: Path, events: EventRows, rows: dict[str, int]) -> None:
    options = pa.ipc.IpcWriteOptions(compression="zstd")
    with (
        pa.OSFile(str(path), "wb") as stream,
        pa.ipc.new_file(stream, events.schema, options=options) as writer,
    ):
        for made in batches:
            for name, batch in made.items():
                rows[name] = rows.get(name, 0) + batch.num_rows
            writer.write_batch(events.of(made))
