"""Captures read as tables, and written as files of tables: what `tables` of a library does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .files.arrow_file import arrow_written, names_in, refuse_target
from .files.parquet import parquet_written
from .files.rereading import rereadable
from .reader import batches
from .schema import schemas_of
from .tables import gathered

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator

    from .._codec.protocol_codec import ProtocolCodec
    from .._frame.direction import Direction
    from .reader import Batches
    from .source import Source
    from .tables import Tables


def read(codec: ProtocolCodec, source: Source, form: str, direction: Direction | None) -> Tables:
    """Read a capture into memory, as one table a message, and one of noise."""
    return gathered(schemas_of(codec), batches(codec, source, form, direction))


def read_batches(
    codec: ProtocolCodec, source: Source, form: str, direction: Direction | None, block: int
) -> Iterator[Batches]:
    """Yield the same stretch by stretch. Raises ValueError for a block of less than a byte."""
    if block < 1:
        raise ValueError(f"block: {block} is below 1, the least there can be")
    return batches(codec, source, form, direction, block)


def write_parquet(
    codec: ProtocolCodec,
    source: Source,
    folder: str | os.PathLike[str],
    form: str,
    direction: Direction | None,
) -> dict[str, int]:
    """Write the tables of a capture as FOLDER/<Table>.parquet, and return the rows of each."""
    names = schemas_of(codec).layouts.names
    return parquet_written(names, batches(codec, source, form, direction), folder)


def write_arrow(
    codec: ProtocolCodec,
    source: Source,
    file: str | os.PathLike[str],
    form: str,
    direction: Direction | None,
) -> dict[str, int]:
    """Write a capture as one Arrow IPC file, and return the rows of each table."""
    refuse_target(file)
    with rereadable(source) as again:
        names = names_in(codec, again(), form, direction)
        made = batches(codec, again(), form, direction)
        return arrow_written(schemas_of(codec), made, file, names)
