"""Whatever holds a capture, its tables are the same: files, bytes, streams and recordings."""

import io
import mmap
import re
from collections.abc import Iterable, Iterator
from datetime import datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import busservo
import numpy as np
import pytest
from busservo import Direction, Message, Noise, strategies, tables
from busservo.recordings import Entry, RecordingError, read
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.strategies import HEADS, damaged_frames, directions, lines, unknown_frames
from tests.unit.runtime.tables.rows import (
    Row,
    fields_of,
    joined,
    noise_row,
    rows_in_tables,
    rows_of_decoder,
)

STOP, VOLTAGE = bytes.fromhex("55 55 02 07"), bytes.fromhex("55 55 04 0F 4C 1D")
LINE = STOP + b"\0\0" + VOLTAGE + bytes.fromhex("55 55 03 63 2A") + STOP + bytes(900) + STOP

# --- Raw bytes -----------------------------------------------------------------------------------


class Pieces:
    """A stream that brings a few bytes at once."""

    def __init__(self, data: bytes, size: int) -> None:
        self._held = io.BytesIO(data)
        self._size = size

    def read(self, size: int, /) -> bytes:
        return self._held.read(min(self._size, size))


@in_turn(
    "source, problem",
    lambda: [
        (None, "a file name, bytes or a stream of bytes expected, not NoneType"),
        ([0x55, 0x55], "a file name, bytes or a stream of bytes expected, not list"),
        (iter([LINE]), "a file name, bytes or a stream of bytes expected, not list_iterator"),
        (io.StringIO("55 55"), "a stream of bytes expected, not of text: open the file with 'rb'"),
        (np.zeros((3, 4), np.uint8)[:, :2], "the array is no run of bytes as it lies in memory"),
    ],
)
@in_turn("use", lambda: [tables.read, tables.write_parquet, tables.write_arrow])
def test_what_is_no_capture_is_refused_by_its_type(
    tmp_path: Path, use: Any, source: Any, problem: str
) -> None:
    target = () if use is tables.read else (tmp_path / "out",)
    with pytest.raises(TypeError, match=re.escape(problem)):
        use(source, *target)
    assert [*tmp_path.iterdir()] == []


def test_a_stretch_has_at_least_a_byte() -> None:
    for block in (0, -1):
        with pytest.raises(ValueError, match=f"block: {block} is below 1"):
            tables.read_batches(LINE, block=block)


def test_a_notebook_shows_the_tables_that_have_rows() -> None:
    shown = tables.read(LINE)._repr_html_()
    assert "<tr><td>BatteryVoltage</td><td>1</td></tr>" in shown
    assert shown.count("<tr>") == 1 + len(tables.read(LINE).filled)


@in_turn("block", lambda: [7, None])
@in_turn(
    "hold",
    lambda: [
        bytes,
        bytearray,
        memoryview,
        io.BytesIO,
        lambda data: np.frombuffer(data, np.uint8),
        lambda data: Pieces(data, 1),
        lambda data: Pieces(data, 700),
        lambda data: io.BufferedReader(io.BytesIO(data)),
    ],
)
def test_a_capture_may_be_held_by_anything(hold: Any, block: int | None) -> None:
    expected = rows_of_decoder(busservo, LINE)
    for form in ("raw", "auto"):
        assert rows_in_tables(busservo, hold(LINE), block=block, form=form) == expected


def test_a_capture_may_be_a_file_or_a_map_of_one(tmp_path: Path) -> None:
    file = tmp_path / "line.bin"
    file.write_bytes(LINE)
    expected = rows_of_decoder(busservo, LINE)
    assert rows_in_tables(busservo, file) == expected
    assert rows_in_tables(busservo, str(file), form="auto") == expected
    with file.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as held:
        assert rows_in_tables(busservo, held, block=600) == expected


def test_batches_are_never_larger_than_their_stretch() -> None:
    line = STOP * 5000
    batches = [*tables.read_batches(line, form="raw", block=1000)]
    rows = [batch.num_rows for found in batches for batch in found.values()]
    assert sum(rows) == 5000
    # A block, and what the one before it held back.
    assert max(rows) <= (1000 + 2 * 265) // len(STOP)


def test_what_is_no_capture_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        tables.read(tmp_path / "none.bin")
    with pytest.raises(ValueError, match="'table' is none of the forms auto, hex, raw"):
        tables.read(b"", form="table")
    with pytest.raises(RecordingError, match="line 1"):
        tables.read(b"55 5G", form="hex")


def test_nothing_holds_nothing() -> None:
    for form in ("auto", "hex", "raw"):
        assert rows_in_tables(busservo, b"", form=form) == []


# --- Text ----------------------------------------------------------------------------------------

chunks = st.one_of(
    strategies.messages().map(Message.encode),
    damaged_frames(),
    unknown_frames(),
    st.sampled_from(HEADS),
    st.binary(min_size=1, max_size=6),
)


def rows_of(entries: Iterable[Entry]) -> list[Row]:
    """Return the entries of a recording as rows."""
    return joined(_rows_of(entries))


def _rows_of(entries: Iterable[Entry]) -> Iterator[Row]:
    for entry in entries:
        direction = None if entry.direction is None else entry.direction.value
        if isinstance(entry.event, Noise):
            row = noise_row(busservo, entry.event, entry.offset, direction)
        else:
            name, size = type(entry.event).__name__, len(entry.event.encode())
            row = Row(name, entry.offset, size, direction, fields=fields_of(entry.event))
        clock = None
        if entry.began is not None and entry.time is not None:
            clock = datetime.fromtimestamp(round(entry.began + entry.time, 6), timezone.utc)
        yield row._replace(time=entry.time, clock=clock)


@given(st.lists(lines, max_size=4), directions)
def test_hex_is_one_stream_but_for_quiet(parts: list[bytes], direction: Direction | None) -> None:
    text = "# quiet\n".join(part.hex(" ") + "  # said\n" for part in parts).encode()
    found = rows_in_tables(busservo, text, direction, form="hex")
    # Noise on both sides of a silence is joined as well: nothing is between it.
    assert found == rows_of(read(io.BytesIO(text), form="hex", direction=direction))


@st.composite
def recordings(draw: st.DrawFn) -> str:
    """Return a recording as `monitor` writes it, of messages and of what is none."""
    who = st.sampled_from(["host", "controller", "either", "host noise", "noise"])
    began = draw(
        st.sampled_from(
            ["", "# recorded of line by busservo from 2024-02-29 23:59:59.123456 +0130 on\n"]
        )
    )
    written = began
    for at in sorted(draw(st.lists(st.integers(0, 10**9), max_size=8))):
        data = draw(chunks)
        written += f"{data.hex(' ')}  # {at / 10**6:.6f} s, {draw(who)}: what it was\n"
    return written


@given(recordings(), directions)
def test_a_recording_says_when_and_from_whom(text: str, direction: Direction | None) -> None:
    found = rows_in_tables(busservo, text.encode(), direction, form="hex")
    expected = [*_rows_of(read(io.BytesIO(text.encode()), form="hex", direction=direction))]
    assert found == expected


def test_a_recording_in_all_its_columns() -> None:
    text = (
        b"# recorded of COM3 from 2024-01-02 03:04:05.500000 +0100 on\n"
        b"55 55 02 07  # 0.250000 s, host: ActionGroupStop()\n"
        b"55 55 04 0F 4C 1D  # 1.500000 s, controller: BatteryVoltage(voltage_mv=7500)\n"
        b"00 01  # 2.000000 s, noise: bad header\n"
        b"00 02  # 3.000000 s, noise: bad header\n"
    )

    def at(second: int, micro: int) -> datetime:
        return datetime(2024, 1, 2, 2, 4, second, micro, timezone.utc)

    assert rows_in_tables(busservo, text, form="auto") == [
        Row("ActionGroupStop", 0, 4, "host_to_controller", None, 0.25, {}, at(5, 750_000)),
        Row(
            "BatteryVoltage",
            *(4, 6, "controller_to_host", None, 1.5),
            {"voltage_mv": 7500},
            at(7, 0),
        ),
        # Of two lines, which may be far from each other.
        Row("noise", 10, 2, "controller_to_host", "bad header", 2.0, None, at(7, 500_000)),
        Row("noise", 12, 2, "controller_to_host", "bad header", 3.0, None, at(8, 500_000)),
    ]


@given(st.integers(0, 10**11))
def test_the_time_of_day_is_right_to_the_microsecond(microseconds: int) -> None:
    text = (
        "# recorded of COM3 from 2024-01-02 03:04:05.500000 +0000 on\n"
        f"55 55 02 07  # {microseconds // 10**6}.{microseconds % 10**6:06} s, host: a stop\n"
    )
    (row,) = rows_in_tables(busservo, text.encode(), form="hex")
    began = datetime(2024, 1, 2, 3, 4, 5, 500_000, timezone.utc)
    assert row.clock == began + timedelta(microseconds=microseconds)
