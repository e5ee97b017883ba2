"""Rows of captures as columns: beside the decoder and its objects, into files, and as archives."""

from __future__ import annotations

import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

from busservo import Noise, StreamDecoder, tables

from benchmarks import captures, sampling
from benchmarks.column_rows import ARCHIVES, FILES, SHARES
from benchmarks.results import AS_TABLES, DECODED, DICTS, Results, WrongResultError

if TYPE_CHECKING:
    from collections.abc import Callable

_MEGABYTE = 1_000_000
_TIMES = 16
"""How often the conversation is repeated, so that its end hardly counts."""

_FILES = 8
_CHUNK = 65536

_DECODE = "for start in range(0, len(data), chunk):\n    feed(data[start : start + chunk])"
_TO_DICT = """\
for start in range(0, len(data), chunk):
    for event in feed(data[start : start + chunk]):
        if not isinstance(event, Noise):
            event.to_dict()
"""
_BATCHES = "for _ in read_batches(data, form='raw'):\n    pass"


def measure(row: str, rounds: int, into: Results, *, quick: bool) -> None:
    """Measure a row, in milliseconds for a megabyte of both directions."""
    times = 4 if quick else _TIMES
    try:
        if row in SHARES:
            _measure_columns(row, rounds, times, into)
        elif row in FILES:
            _measure_file(row, rounds, times, into)
        else:
            _measure_archive(row, rounds, times, into)
    except WrongResultError as error:
        into.refuse(row, AS_TABLES, error)


def _measure_columns(row: str, rounds: int, times: int, into: Results) -> None:
    """Measure decoder, objects and columns in turn; the columns also as a share of the others."""
    one = captures.disturbed(SHARES[row])
    many = one * times
    _compare(one)
    names: dict[str, Any] = {
        "Noise": Noise,
        "StreamDecoder": StreamDecoder,
        "read_batches": tables.read_batches,
        "chunk": _CHUNK,
    }
    begin = "feed = StreamDecoder(None).feed"
    samples: dict[str, Callable[[], float]] = {
        DECODED: lambda: _cpu(_DECODE, {**names, "data": one}, begin),
        DICTS: lambda: _cpu(_TO_DICT, {**names, "data": one}, begin),
        AS_TABLES: lambda: _cpu(_BATCHES, {**names, "data": many}, "pass"),
    }
    taken: dict[str, list[float]] = {name: [] for name in samples}
    for _ in range(rounds):
        for name, sample in samples.items():
            taken[name].append(sample())
    for name, values in taken.items():
        into.measurements[row, name] = sampling.spread(values)
    for name in (DECODED, DICTS):
        pairs = [*zip(taken[AS_TABLES], taken[name], strict=True)]
        into.measurements[f"{row}-share", name] = sampling.ratio(pairs)


def _compare(data: bytes) -> None:
    """Refuse tables that hold anything but the events of the decoder."""
    decoder = StreamDecoder(None)
    events = [*decoder.feed(data), *decoder.flush()]
    messages = sum(not isinstance(event, Noise) for event in events)
    noise = sum(len(event.data) for event in events if isinstance(event, Noise))
    made = tables.read(data, form="raw")
    rows = sum(table.num_rows for name, table in made.items() if name != tables.NOISE)
    size = sum(made[tables.NOISE]["size"].to_pylist())
    if (rows, size) != (messages, noise):
        raise WrongResultError(
            f"{rows} rows and {size} bytes of noise, not {messages} messages and {noise}"
        )


def _cpu(statement: str, names: dict[str, Any], setup: str) -> float:
    """Return the CPU milliseconds of a statement for a megabyte of `data`."""
    seconds = sampling.statement_seconds(statement, names, 1, setup)
    return 1000 * seconds / (len(names["data"]) / _MEGABYTE)


def _measure_file(row: str, rounds: int, times: int, into: Results) -> None:
    """Write a file, or a folder of files, of a capture on the disk."""
    write = getattr(tables, FILES[row])
    data = captures.disturbed(0) * times
    taken = []
    with tempfile.TemporaryDirectory() as folder:
        capture = Path(folder, "line.bin")
        capture.write_bytes(data)
        for number in range(rounds + 1):
            names = {"write": write, "capture": capture, "to": Path(folder, f"{number}")}
            taken.append(_cpu("write(capture, to)", {**names, "data": data}, "pass"))
    # The first one warms up.
    into.measurements[row, AS_TABLES] = sampling.spread(taken[1:])


def _measure_archive(row: str, rounds: int, times: int, into: Results) -> None:
    """Convert a folder of captures by some processes: in CPU time of all, and on the clock."""
    workers = ARCHIVES[row]
    one = captures.disturbed(0) * times
    taken, passed = [], []
    with (
        tempfile.TemporaryDirectory() as folder,
        ProcessPoolExecutor(workers, get_context("spawn")) as pool,
    ):
        files = [Path(folder, f"{number}.bin") for number in range(_FILES)]
        for file in files:
            file.write_bytes(one)
        pieces = tables.scan(files, size=len(one))
        size = len(one) * _FILES / _MEGABYTE
        for number in range(rounds + 1):
            work = partial(_archive, folder=Path(folder, f"to-{number}"))
            began = time.perf_counter()
            seconds = [*pool.map(work, pieces)]
            passed.append(1000 * (time.perf_counter() - began) / size)
            taken.append(1000 * sum(seconds) / size)
    # The first one warms up.
    into.measurements[row, AS_TABLES] = sampling.spread(taken[1:])
    into.measurements[f"{row}-clock", AS_TABLES] = sampling.spread(passed[1:])


def _archive(piece: tables.Piece, folder: Path) -> float:
    """Return the CPU seconds of one piece."""
    began = time.process_time()
    report = tables.archive(piece, folder)
    if report.error is not None:
        raise WrongResultError(report.error)
    return time.process_time() - began
