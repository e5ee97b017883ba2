"""Ids and addresses of any width: of messages and of unknown frames, to their highest values."""

from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Any

import pyarrow as pa
import pytest
from framegen.model.checksums import CHECKSUMS
from framewire.tables.stats.statistics import statistics
from hypothesis import example, given
from hypothesis import strategies as st

from tests.factories import compiled_of, library, library_files
from tests.few_each import few_each
from tests.unit.runtime.tables.rows import rows_in_tables, rows_of_decoder

WIDTHS = [8, 16, 24, 32, 64]


def spec_of(bits: int) -> dict[str, Any]:
    """Return a spec whose devices and messages have numbers of so many bits."""
    part = {"type": f"u{bits}", "about": "A number."}
    message = {
        "direction": "host -> device",
        "summary": "A message.",
        "cite": "nobody",
        "fields": {"level": {"type": "u8", "about": "A level."}},
    }
    return {
        "framegen": 2,
        "protocol": {
            "name": "wide",
            "title": "Wide",
            "version": "1.0.0",
            "authority": "nobody",
            "summary": "Wide numbers.",
        },
        "sources": {"nobody": {"title": "Made up", "kind": "document"}},
        "endpoints": {"host": "A host.", "device": "A device."},
        "link": {"baud": 9600},
        "byte_order": "big",
        "frame": {
            "header": {"is": "constant", "bytes": "A5 5A", "about": "The start."},
            "station": {"is": "address", "range": f"0..{(1 << bits) - 2}", **part},
            "length": {
                "is": "length",
                "type": "u8",
                "counts": ["parameters"],
                "about": "How long.",
            },
            "command": {"is": "id", **part},
            "parameters": {"is": "body", "about": "The fields."},
            "check": {
                "is": "checksum",
                "type": "u8",
                "method": "sum",
                "covers": ["station", "length", "command", "parameters"],
                "about": "A check.",
            },
        },
        "messages": {
            name: {**message, "id": number, "length": 1}
            for name, number in {"Low": 1, "High": (1 << bits) - 1}.items()
        },
    }


@cache
def made_by(bits: int) -> dict[str, str]:
    data = spec_of(bits)
    for number in (1, (1 << bits) - 1):
        message = data["messages"]["Low" if number == 1 else "High"]
        values = {"station": 1, "level": 7}
        made = frame(bits, 1, number, b"\x07").hex(" ").upper()
        message["examples"] = [{"title": "One", "hex": made, "values": values, "cite": "nobody"}]
    return library_files(compiled_of(data))


def frame(bits: int, station: int, command: int, parameters: bytes) -> bytes:
    size = bits // 8
    covered = station.to_bytes(size, "big") + bytes([len(parameters)])
    covered += command.to_bytes(size, "big") + parameters
    return b"\xa5\x5a" + covered + bytes([CHECKSUMS["sum"].of(covered, 8)])


def part(made: ModuleType, name: str) -> Any:
    return import_module(f"{made.__name__}.{name}")


@pytest.mark.parametrize("bits", WIDTHS)
def test_numbers_of_any_width_are_in_the_tables(bits: int) -> None:
    highest = (1 << bits) - 1
    numbers = st.integers(0, highest) | st.sampled_from([0, 1, highest // 2, highest // 2 + 1])

    with library(made_by(bits)) as made:

        @few_each
        @given(
            sent=st.lists(
                st.tuples(numbers, numbers | st.sampled_from([1, highest]), st.binary(max_size=3)),
                max_size=5,
            )
        )
        @example(sent=[(highest - 1, highest - 1, b"\x07"), (highest - 1, highest, b"\x07")])
        def check(sent: list[tuple[int, int, bytes]]) -> None:
            line = b"".join(frame(bits, *each) for each in sent)
            rows = rows_in_tables(made, line)
            assert rows == rows_of_decoder(made, line)
            found = statistics(part(made, "_library").CODEC, line, form="raw")
            unknown = [row for row in rows if row.table == "unknown"]
            assert sum(each.count for each in found.unknown) == len(unknown)
            stations = {row.fields["station"] for row in rows if row.table in ("Low", "High")}
            assert {each.key for each in found.ranges} == stations

        check()
        kinds = {column.name: column.type for column in part(made, "tables").schemas()["noise"]}
        assert kinds["station"] == kinds["command"] == (pa.uint64() if bits == 64 else pa.int64())
