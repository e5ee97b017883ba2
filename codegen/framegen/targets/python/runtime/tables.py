"""Captures as Arrow tables, one a message: every field by name, for pandas, Polars or DuckDB.

    tables = read("line.bin")
    print(tables)

It needs NumPy and PyArrow, which the extra `tables` of this package brings.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

from ._frame.direction import Direction
from ._recording.layout import NOISE
from ._tables.archive.cuts import safe_cuts
from ._tables.archive.dataset import Report, archive
from ._tables.archive.pieces import PIECE, Piece, scan
from ._tables.files.arrow_file import arrow_written, names_in, refuse_target
from ._tables.files.parquet import parquet_written
from ._tables.files.rereading import rereadable
from ._tables.reader import BLOCK, Batches, batches
from ._tables.schema import schemas
from ._tables.source import Source
from ._tables.tables import Tables, gathered

__all__ = [
    "BLOCK",
    "NOISE",
    "PIECE",
    "Batches",
    "Piece",
    "Report",
    "Source",
    "Tables",
    "archive",
    "read",
    "read_batches",
    "safe_cuts",
    "scan",
    "schemas",
    "write_arrow",
    "write_parquet",
]


def read(source: Source, *, form: str = "auto", direction: Direction | None = None) -> Tables:
    """Read a capture into memory, as one table a message, and one of noise.

    `source` is the name of a file, bytes of any kind (a memory map, an array), or a stream of
    bytes. `form` is one of recordings.FORMS. `direction` is the sender of bytes for which the
    capture names none; None for a line on which both ends are received.

    The events are exactly those of StreamDecoder, with neighbouring noise joined. Raises
    RecordingError for text that makes no sense, OSError for a file that cannot be read, and
    TypeError for a source that is no bytes.
    """
    return gathered(batches(source, form, direction))


def read_batches(
    source: Source,
    *,
    form: str = "auto",
    direction: Direction | None = None,
    block: int = BLOCK,
) -> Iterator[Batches]:
    """Yield the same stretch by stretch, of `block` bytes, so that memory is bounded.

    Each stretch is a dict of record batches by the name of their table, without those that would be
    empty. The batches of a table, one after the other, are the table that `read` returns.
    Raises as `read` does, and ValueError for a block of less than a byte.
    """
    if block < 1:
        raise ValueError(f"block: {block} is below 1, the least there can be")
    return batches(source, form, direction, block)


def write_parquet(
    source: Source,
    folder: str | os.PathLike[str],
    *,
    form: str = "auto",
    direction: Direction | None = None,
) -> dict[str, int]:
    """Write the tables of a capture as FOLDER/<Table>.parquet, and return the rows of each.

    A table without rows has no file. The folder is made; files of an earlier capture are replaced.
    Raises FileExistsError if it holds anything else, RecordingError and OSError as `read`, and
    leaves no file half-written.
    """
    return parquet_written(batches(source, form, direction), folder)


def write_arrow(
    source: Source,
    file: str | os.PathLike[str],
    *,
    form: str = "auto",
    direction: Direction | None = None,
) -> dict[str, int]:
    """Write a capture as one Arrow IPC file, and return the rows of each table.

    It has all events in the order of the capture: `event` is the name of a message, `noise` or
    `unknown`, and each message that occurs has a column of structs, null in the rows of others. The
    capture is read twice; a stream is copied to disk for that. Raises FileExistsError if the file
    is there and no Arrow file, RecordingError and OSError as `read`, and leaves no file
    half-written.
    """
    refuse_target(file)
    with rereadable(source) as again:
        names = names_in(again(), form, direction)
        return arrow_written(batches(again(), form, direction), file, names)
