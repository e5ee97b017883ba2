"""A capture written as Parquet files or as one Arrow file: apart, since they need `tables`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..recording.layout import NOISE
from ..tables.files.arrow_file import arrow_written, names_in, refuse_target
from ..tables.files.parquet import parquet_written
from ..tables.reader import batches
from ..tables.schema import schemas_of
from .rereading import rereadable

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from ..codec.counters import Counters
    from ..frame.direction import Direction
    from ..tables.reader import Batches
    from .recording import Recording


def write_parquet(
    recording: Recording, form: str, direction: Direction | None, folder: Path, seen: Counters
) -> dict[str, int]:
    """Write a folder of tables, and return the rows of each file. Raises OSError."""
    with recording.from_the_beginning():
        made = _counted(batches(recording.codec, recording, form, direction), seen)
        rows = parquet_written(schemas_of(recording.codec).layouts.names, made, folder)
    return {str(folder / f"{name}.parquet"): count for name, count in rows.items()}


def write_arrow(
    recording: Recording, form: str, direction: Direction | None, file: Path, seen: Counters
) -> dict[str, int]:
    """Write a file of all events, and return the rows of each table. Raises OSError."""
    refuse_target(file)
    # Which columns there are is known only when all of it has been read.
    with rereadable(recording) as twice:
        twice.is_quiet = True
        with twice.from_the_beginning():
            names = names_in(twice.codec, twice, form, direction)
        with twice.from_the_beginning():
            made = _counted(batches(twice.codec, twice, form, direction), seen)
            return arrow_written(schemas_of(twice.codec), made, file, names)


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
