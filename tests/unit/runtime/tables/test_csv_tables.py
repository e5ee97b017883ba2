"""CSV files of any protocol hold what its stream decoder finds, written out in another way."""

import csv
import io
import struct
from importlib import import_module
from itertools import zip_longest
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.handed import handed_by
from tests.protocols.libraries import Libraries, direction_of
from tests.protocols.specs import model_of
from tests.protocols.streams import lines
from tests.unit.runtime.tables.rows import Row, rows_of_decoder


def written(made: ModuleType, line: bytes, direction: Any) -> list[tuple[str, dict[str, str]]]:
    """Return the rows of all files, in the order of the capture, as they are read back."""
    tables: Any = import_module("framewire.command.csv_tables")
    recordings: Any = import_module(f"{made.__name__}.recordings")
    with TemporaryDirectory() as folder:
        entries = recordings.read(io.BytesIO(line), form="raw", direction=direction)
        codec = handed_by(made.__name__).codec
        counts = tables.csv_written(entries, Path(folder) / "tables", codec)
        found = []
        for file in Path(folder, "tables").iterdir():
            with file.open(encoding="utf-8", newline="") as stream:
                rows = [*csv.DictReader(stream, strict=True)]
            assert counts.pop(file.stem) == len(rows)
            assert not any(None in row or None in row.values() for row in rows)
            found += [(file.stem, row) for row in rows]
    assert counts == {}
    return sorted(found, key=lambda pair: int(pair[1]["offset"]))


def expected(row: Row) -> list[tuple[str, dict[str, str]]]:
    """Return the rows of one event, from the fields that the decoder names."""
    begin = {
        "offset": str(row.offset),
        "size": str(row.size),
        "direction": row.direction or "",
        "time": "",
        "clock": "",
    }
    fields = dict(row.fields or {})
    if row.table in ("noise", "unknown"):
        begin |= {"reason": str(row.reason), "unknown": str(row.table == "unknown").lower()}
        parameters = fields.pop("parameters", b"").hex(" ").upper()
        numbers = {name: text(value) for name, value in fields.items()}
        return [("noise", {**begin, **numbers, "parameters": parameters})]
    lists = {name: value for name, value in fields.items() if isinstance(value, list)}
    begin |= {name: text(fields[name]) for name in fields if name not in lists}
    if not lists:
        return [(row.table, begin)]
    flat = [flattened(name, value) for name, value in lists.items()]
    made = []
    for index, elements in enumerate(zip_longest(*flat, fillvalue={})):
        one = {name: value for each in elements for name, value in each.items()}
        made.append((row.table, {**begin, "index": str(index), **one}))
    return made or [(row.table, {**begin, "index": ""})]


def flattened(name: str, values: list[Any]) -> list[dict[str, str]]:
    return [
        {f"{name}.{each}": text(value) for each, value in element.items()}
        if isinstance(element, dict)
        else {name: text(element)}
        for element in values
    ]


def text(value: Any) -> str:
    if isinstance(value, bytes):  # a float, as its bits
        return str(struct.unpack(">d", value)[0])
    return "" if value is None else str(value)


@pytest.mark.parametrize("name", ["everything", "sbus", "ubx"])
@settings(max_examples=12)
@given(data=st.data())
def test_csv_files_hold_what_the_decoder_finds(
    libraries: Libraries, name: str, data: st.DataObject
) -> None:
    made, model = libraries[name], model_of(name)
    way = data.draw(st.sampled_from([*model.directions]))
    line = data.draw(lines(name, way))
    direction = direction_of(made, way)
    found = written(made, line, direction)
    rows = [each for row in rows_of_decoder(made, line, direction) for each in expected(row)]
    # What is empty in a file may be absent in what is expected.
    assert [(table, {k: v for k, v in cells.items() if v}) for table, cells in found] == [
        (table, {k: v for k, v in cells.items() if v}) for table, cells in rows
    ]
