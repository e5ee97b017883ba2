"""A capture as CSV files, one a message and one of noise: with the columns of all other tables.

CSV has no lists: a message with a list has a row for each element, with all else repeated.
"""

from __future__ import annotations

import csv
import io
from datetime import datetime, timezone
from itertools import zip_longest

from ..codec.event_bytes import bytes_of
from ..codec.noise import Noise, UnknownFrame
from ..frame.bytes_like import format_hex
from ..frame.free_name import free_name
from ..recording.layout import (
    EVENT_COLUMNS,
    NOISE,
    PARAMETERS,
    REASON_COLUMN,
    UNKNOWN_COLUMN,
    layouts_of,
)
from ..recording.table_folder import TableFolder

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path
    from typing import Any

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.message import Message
    from ..recording.entry import Entry
    from ..recording.layout import Column, Layout, Layouts

# So many rows are held before they are written.
_HELD = 20_000


def csv_written(entries: Iterable[Entry], folder: Path, codec: ProtocolCodec) -> dict[str, int]:
    """Write tables as FOLDER/<Table>.csv, and return the rows of each.

    The folder is made, or holds nothing but such files, which are replaced. Raises FileExistsError
    if it holds something else, and OSError. Whatever goes wrong, no file is half-written.
    """
    layouts = layouts_of(codec)
    noise = [*EVENT_COLUMNS, REASON_COLUMN, UNKNOWN_COLUMN]
    noise += [*(column for column, _ in layouts.unknown_columns.values()), PARAMETERS]
    target = TableFolder(layouts.names, folder, ".csv")
    with target.replaced() as written:
        files = _Files(target, written)
        shapes = {each.kind: _Shape(each) for each in layouts.every}
        for entry, size in _joined(entries):
            event = entry.event
            if isinstance(event, Noise):
                files.add(NOISE, noise, [[*_of_event(entry, size), *_of_noise(event, layouts)]])
            else:
                shape = shapes[type(event)]
                files.add(shape.name, shape.columns, shape.rows(entry, size, event))
        files.end()
    return files.rows


class _Files:
    """The files that are being written. One is open at a time: there may be many tables."""

    def __init__(self, target: TableFolder, written: set[str]) -> None:
        self._target = target
        self._written = written
        self._held: dict[str, list[list[object]]] = {}
        self._count = 0
        self.rows: dict[str, int] = {}

    def add(self, name: str, columns: list[str], rows: list[list[object]]) -> None:
        """Add rows to a table."""
        held = self._held.setdefault(name, [])
        if name not in self.rows:
            # What a stopped run has left behind.
            self._target.unfinished(name).unlink(missing_ok=True)
            self.rows[name] = 0
            held.append([*columns])
        held += rows
        self.rows[name] += len(rows)
        self._count += len(rows)
        if self._count >= _HELD:
            self.end()

    def end(self) -> None:
        """Write what is held."""
        for name, rows in self._held.items():
            text = io.StringIO()
            # As RFC 4180 has it, on every system.
            csv.writer(text, lineterminator="\r\n").writerows(rows)
            self._written.add(name)
            with self._target.unfinished(name).open("ab") as stream:
                stream.write(text.getvalue().encode("utf-8", "backslashreplace"))
        self._held.clear()
        self._count = 0


class _Shape:
    """How a message becomes rows."""

    def __init__(self, layout: Layout) -> None:
        self.name = layout.name
        self._single = [each for each in layout.columns if not each.is_list]
        lists = [each for each in layout.columns if each.is_list]
        self._lists = [(each, layout.element_names(each)) for each in lists]
        names = [*EVENT_COLUMNS, *(each.name for each in self._single)]
        if lists:
            index = free_name("index", [each.name for each in layout.columns])
            names += [index, *(name for each in self._lists for name in _names(*each))]
        self.columns = names

    def rows(self, entry: Entry, size: int, message: Message) -> list[list[object]]:
        """Return a row for each element of its lists: one without an index if these are empty."""
        values: dict[str, Any] = message.to_dict()
        begin = _of_event(entry, size)
        begin += [_cell(values[each.attribute]) for each in self._single]
        if not self._lists:
            return [begin]
        # The shorter of two lists goes on with nothing.
        nothing: list[list[object]] = [[""] * len(_names(*each)) for each in self._lists]
        parts = [
            [_cells(element, names) for element in values[column.attribute]]
            for column, names in self._lists
        ]
        rows = [
            [*begin, index, *_filled(row, nothing)] for index, row in enumerate(zip_longest(*parts))
        ]
        return rows or [[*begin, "", *_filled(nothing, nothing)]]


def _names(column: Column, elements: tuple[str, ...]) -> list[str]:
    return [f"{column.name}.{each}" for each in elements] or [column.name]


def _filled(row: Iterable[list[object] | None], nothing: list[list[object]]) -> Iterator[object]:
    for cells, none in zip(row, nothing, strict=True):
        yield from cells or none


def _cells(element: Any, names: tuple[str, ...]) -> list[object]:
    return [_cell(element[name]) for name in names] if names else [_cell(element)]


def _cell(value: object) -> object:
    """Return a value as CSV has it: an absent one is nothing."""
    return "" if value is None else value


def _of_event(entry: Entry, size: int) -> list[object]:
    time, began = entry.time, entry.began
    return [
        entry.offset,
        size,
        "" if entry.direction is None else entry.direction.value,
        "" if time is None else f"{time:.6f}",
        "" if time is None or began is None else _clock(began + time),
    ]


def _clock(seconds: float) -> str:
    at = datetime.fromtimestamp(round(seconds * 1e6) / 1e6, timezone.utc)
    return f"{at:%Y-%m-%dT%H:%M:%S.%fZ}"


def _of_noise(event: Noise, layouts: Layouts) -> list[object]:
    numbers: dict[str, int] = {}
    parameters = ""
    unknown = "false"
    if isinstance(event, UnknownFrame):
        unknown, numbers, parameters = "true", event.numbers, format_hex(event.parameters)
    cells = [numbers.get(name, "") for name in layouts.unknown_columns]
    return [event.reason.value, unknown, *cells, parameters]


def _joined(entries: Iterable[Entry]) -> Iterator[tuple[Entry, int]]:
    """Yield entries with their sizes; neighbouring noise of one reason is one, without times."""
    held: Entry | None = None
    held_size = 0
    for entry in entries:
        size = len(bytes_of(entry.event))
        if held is not None:
            if _goes_on(held, entry):
                held_size += size
                continue
            yield held, held_size
        held, held_size = entry, size
    if held is not None:
        yield held, held_size


def _goes_on(before: Entry, after: Entry) -> bool:
    """Return whether noise goes on with the noise in front: each line of a recording is alone."""
    one, other = before.event, after.event
    if type(one) is not Noise or type(other) is not Noise:
        return False
    return before.time is None and after.time is None and one.reason is other.reason
