"""Captures as Arrow tables, one a message: every field by name, for pandas, Polars or DuckDB.

    tables = read("line.bin")
    print(tables)

It needs NumPy and PyArrow, which the extra `tables` of this package brings.
"""

from __future__ import annotations

from collections.abc import Iterator

from ._frame.direction import Direction
from ._tables.reader import BLOCK, Batches, batches
from ._tables.schema import NOISE, schemas
from ._tables.source import Source
from ._tables.whole import Tables, gathered

__all__ = ["BLOCK", "NOISE", "Batches", "Source", "Tables", "read", "read_batches", "schemas"]


def read(source: Source, *, form: str = "auto", direction: Direction | None = None) -> Tables:
    """Read a capture into memory, as one table a message, and one of noise.

    `source` is the name of a file, bytes of any kind (a memory map, an array), or a stream of
    bytes. `form` is one of recordings.FORMS. `direction` is the sender of bytes for which the
    capture names none; None for a line on which both ends are received.

    The events are exactly those of StreamDecoder, with neighbouring noise joined. Raises
    RecordingError for text that makes no sense, and OSError for a file that cannot be read.
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
    """
    return batches(source, form, direction, block)
