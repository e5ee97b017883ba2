"""A capture written as tables: Parquet files in a folder, or one file of Arrow's."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from .._frame.pluralize import pluralize
from .._tables.files.arrow_file import arrow_written, names_in, refuse_target
from .._tables.files.parquet import parquet_written
from .._tables.reader import batches
from .._tables.schema import NOISE
from .capture import direction_in, opened_capture
from .look_alike import beginning
from .rereading import rereadable
from .sheet import Sheet
from .usage_error import UsageError

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator
    from pathlib import Path

    from .._codec.counters import Counters
    from .._frame.direction import Direction
    from .._tables.reader import Batches
    from .recording import Recording


def write_tables(arguments: Namespace, seen: Counters) -> bytes:
    """Write the tables, print how many rows each has, and count the events.

    Return how the bytes begin, if most of them are noise. Raises UsageError.
    """
    direction = direction_in(arguments)
    # Before standard input is waited for.
    if arguments.parquet is not None and arguments.parquet.is_file():
        raise UsageError(
            f"{arguments.parquet} cannot be written: it is a file, and --parquet takes a folder"
        )
    with opened_capture(arguments) as (recording, form):
        recording.is_quiet = True
        try:
            if arguments.parquet is not None:
                rows = _parquet(recording, form, direction, arguments.parquet, seen)
            else:
                rows = _arrow(recording, form, direction, arguments.arrow, seen)
        except OSError as error:
            target = arguments.parquet or arguments.arrow
            raise UsageError(f"{target} cannot be written: {error.strerror or error}") from None
        begun = beginning(recording, form, direction) if 2 * seen.noise > seen.fed else b""
    Sheet(sys.stdout).columns([(name, pluralize(count, "row")) for name, count in rows.items()])
    sys.stdout.flush()
    return begun


def _parquet(
    recording: Recording, form: str, direction: Direction | None, folder: Path, seen: Counters
) -> dict[str, int]:
    with recording.from_the_beginning():
        rows = parquet_written(_counted(batches(recording, form, direction), seen), folder)
    return {str(folder / f"{name}.parquet"): count for name, count in rows.items()}


def _arrow(
    recording: Recording, form: str, direction: Direction | None, file: Path, seen: Counters
) -> dict[str, int]:
    refuse_target(file)
    # Which columns there are is known only when all of it has been read.
    with rereadable(recording) as twice:
        twice.is_quiet = True
        with twice.from_the_beginning():
            names = names_in(twice, form, direction)
        with twice.from_the_beginning():
            return arrow_written(_counted(batches(twice, form, direction), seen), file, names)


def _counted(made: Iterator[Batches], seen: Counters) -> Iterator[Batches]:
    """Yield the same batches, and count what they hold."""
    for each in made:
        for name, batch in each.items():
            size = int(batch.column("size").to_numpy().sum())
            seen.fed += size
            if name == NOISE:
                seen.noise += size
                seen.unknown_frames += batch.column("unknown").true_count
            else:
                seen.messages += batch.num_rows
        yield each
