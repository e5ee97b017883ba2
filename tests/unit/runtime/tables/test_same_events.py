"""Tables hold exactly the events of the stream decoder, on whatever line, and whatever holds it."""

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
from busservo import Direction, Noise, strategies, tables
from busservo.recordings import Entry, RecordingError
from hypothesis import example, given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.strategies import directions, lines
from tests.unit.runtime.tables.hostile import hostile_lines
from tests.unit.runtime.tables.rows import (
    Row,
    fields_of,
    noise_row,
    rows_in_tables,
    rows_of_decoder,
)

# What no frame begins with, and enough of it: behind it, a line is decided without its end.
FILLER = bytes(600)
blocks = st.sampled_from([1, 2, 7, 64, 600, 1 << 20])


def holding(inner: bytes) -> bytes:
    """Return a move whose time and targets are these bytes, and what they lack as zeros."""
    count = max(1, -(-(len(inner) - 2) // 3))
    payload = inner.ljust(2 + 3 * count, b"\0")
    return bytes([0x55, 0x55, 5 + 3 * count, 3, count]) + payload


# Frames in frames, and heads of frames that reach behind the end of the one that holds them.
inner = st.sampled_from(
    [
        *map(bytes.fromhex, ("55 55 02 07", "55 55 05 06 08 01 00", "55 55 02 0F", "55 55 02 63")),
        *(bytes([0x55, 0x55, 5 + 3 * count, 3, count]) for count in (1, 2, 3)),
        *map(bytes.fromhex, ("55", "55 55", "55 55 0A", "55 55 05 63", "07", "00", "02 07")),
    ]
)
nests = st.recursive(
    st.lists(inner, max_size=6).map(b"".join),
    lambda held: st.lists(held.map(lambda data: holding(data[:240])) | inner, max_size=4).map(
        b"".join
    ),
    max_leaves=8,
)

servo_frames = strategies.messages().map(busservo.Message.encode)
hostile = lines | hostile_lines(busservo, servo_frames) | nests
tails = st.sampled_from([b"", FILLER])


@given(st.lists(hostile, max_size=3).map(b"".join), tails, directions, blocks)
@example(b"\x55" * 700, b"", None, 7)
@example(b"\x55\x55\x02" * 300, b"", Direction.HOST_TO_CONTROLLER, 64)
@example(b"\x55\x55\xff" * 300, FILLER, None, 600)
@example(b"\x55\x55\x30\x63" * 200, FILLER, Direction.CONTROLLER_TO_HOST, 600)
def test_tables_hold_what_the_decoder_finds(
    line: bytes, tail: bytes, direction: Direction | None, block: int
) -> None:
    line += tail
    found = rows_in_tables(busservo, line, direction, block=block)
    assert found == rows_of_decoder(busservo, line, direction)


STOP, RUN = bytes.fromhex("55 55 02 07"), bytes.fromhex("55 55 05 06 08 01 00")
UNKNOWN = bytes.fromhex("55 55 03 63 2A")
HOST = Direction.HOST_TO_CONTROLLER
HELD = holding(b"\0\0" + STOP + RUN + STOP)
# The head of a move stands at the end of another one, and what it would hold behind that.
REACHING = holding(b"\0\0\0" + bytes.fromhex("55 55 0B 03 02"))
# Typed in by hand: a line with the filler behind it, and what the tables hold in front of that.
WORKED_OUT: list[tuple[bytes, list[tuple[str, int] | tuple[str, int, str]]]] = [
    (STOP, [("ActionGroupStop", 4)]),
    (b"\0" + STOP, [("noise", 1, "bad header"), ("ActionGroupStop", 4)]),
    # The byte in front of the header is one of a header that is refused.
    (b"\x55" + STOP, [("noise", 1, "unknown command"), ("ActionGroupStop", 4)]),
    (UNKNOWN + STOP, [("unknown", 5, "unknown command"), ("ActionGroupStop", 4)]),
    # A claim in which a message begins is none.
    (
        bytes.fromhex("55 55 06 63") + STOP,
        [("noise", 4, "unknown command"), ("ActionGroupStop", 4)],
    ),
    (bytes.fromhex("55 55 09 03") + RUN, [("noise", 4, "length mismatch"), ("ActionGroupRun", 7)]),
    # A header begins at the end of what is claimed, though nothing comes of it.
    (
        bytes.fromhex("55 55 03 63 55 00") + STOP,
        [("noise", 6, "unknown command"), ("ActionGroupStop", 4)],
    ),
    # What a frame holds is no event.
    (HELD + STOP, [("ServoMove", len(HELD)), ("ActionGroupStop", 4)]),
    (
        REACHING + STOP + STOP,
        [("ServoMove", len(REACHING)), ("ActionGroupStop", 4), ("ActionGroupStop", 4)],
    ),
    # Behind the first claim begins the second, within which nothing does; it reaches further.
    (
        bytes.fromhex("55 55 07 63 00 55 55 04 63 00 00") + STOP,
        [("unknown", 9, "unknown command"), ("noise", 2, "bad header"), ("ActionGroupStop", 4)],
    ),
]


def events_of(rows: Iterable[Row]) -> list[tuple[Any, ...]]:
    """Return table, size and reason, if there is one, of rows that leave nothing out."""
    events, end = [], 0
    for row in rows:
        assert (row.offset, row.direction) == (end, HOST.value)
        events.append((row.table, row.size, row.reason)[: 3 if row.reason else 2])
        end += row.size
    return events


@in_turn("block", lambda: [1, 5, 600, None])
@in_turn("line, expected", lambda: WORKED_OUT)
def test_they_hold_what_was_worked_out_by_hand(
    line: bytes, expected: list[tuple[Any, ...]], block: int | None
) -> None:
    rows = rows_in_tables(busservo, line + FILLER, HOST, block=block)
    assert events_of(rows) == [*expected, ("noise", len(FILLER), "bad header")]


# --- What holds a line ----------------------------------------------------------------------------
VOLTAGE = bytes.fromhex("55 55 04 0F 4C 1D")
LINE = STOP + b"\0\0" + VOLTAGE + UNKNOWN + STOP + bytes(900) + STOP


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


def test_a_notebook_shows_the_tables_that_have_rows() -> None:
    shown = tables.read(LINE)._repr_html_()
    assert "<tr><td>BatteryVoltage</td><td>1</td></tr>" in shown
    assert shown.count("<tr>") == 1 + len(tables.read(LINE).filled)


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


def test_what_cannot_be_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        tables.read(tmp_path / "none.bin")
    with pytest.raises(ValueError, match="'table' is none of the forms auto, hex, raw"):
        tables.read(b"", form="table")
    with pytest.raises(RecordingError, match="line 1"):
        tables.read(b"55 5G", form="hex")
    for block in (0, -1):
        with pytest.raises(ValueError, match=f"block: {block} is below 1"):
            tables.read_batches(LINE, block=block)


# --- Text ----------------------------------------------------------------------------------------
def rows_of(entries: Iterable[Entry]) -> Iterator[Row]:
    """Yield the entries of a recording as rows."""
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


def test_a_recording_in_all_its_columns() -> None:
    text = (
        b"# recorded of COM3 from 2024-01-02 03:04:05.500000 +0100 on\n"
        b"55 55 02 07  # 0.250000 s, host: ActionGroupStop()\n"
        b"55 55 04 0F 4C 1D  # 1.500000 s, controller: BatteryVoltage(voltage_mv=7500)\n"
        b"00 01  # 2.000000 s, noise: bad header\n"
        b"00 02  # 3.000000 s, noise: bad header\n"
    )
    at = datetime(2024, 1, 2, 2, 4, 5, 500_000, timezone.utc)
    clocks = {after: at + timedelta(seconds=after) for after in (0.25, 1.5, 2.0, 3.0)}
    to_board, to_host = "host_to_controller", "controller_to_host"
    said = {"direction": to_host, "reason": "bad header"}
    assert rows_in_tables(busservo, text, form="auto") == [
        Row("ActionGroupStop", 0, 4, to_board, None, 0.25, {}, clocks[0.25]),
        Row("BatteryVoltage", 4, 6, to_host, None, 1.5, {"voltage_mv": 7500}, clocks[1.5]),
        # Of two lines, which may be far from each other.
        Row("noise", 10, 2, **said, time=2.0, clock=clocks[2.0]),
        Row("noise", 12, 2, **said, time=3.0, clock=clocks[3.0]),
    ]
