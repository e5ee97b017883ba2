"""A capture written as tables: CSV or Parquet files in a folder, or one file of Arrow's."""

from __future__ import annotations

import sys

from ..frame.pluralize import pluralize
from .capture import direction_in, opened_capture
from .csv_tables import csv_written
from .events import counted
from .extra import imported
from .look_alike import beginning
from .sheet import Sheet
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable
    from pathlib import Path

    from ..codec.counters import Counters
    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from .recording import Recording

    _Write = Callable[[Recording, str, Direction | None, Path, Counters], dict[str, int]]


def write_tables(arguments: Namespace, seen: Counters, codec: ProtocolCodec) -> bytes:
    """Write the tables, print how many rows each has, and count the events.

    Return how the bytes begin, if most of them are noise. Raises UsageError.
    """
    direction = direction_in(arguments, codec)
    # Before standard input is waited for.
    target, write = _chosen(arguments, codec.package)
    with opened_capture(arguments, codec) as (recording, form):
        recording.is_quiet = True
        try:
            rows = write(recording, form, direction, target, seen)
        except OSError as error:
            raise UsageError(f"{target} cannot be written: {error.strerror or error}") from None
        begun = beginning(recording, form, direction) if 2 * seen.noise > seen.fed else b""
    Sheet(sys.stdout).columns([(name, pluralize(count, "row")) for name, count in rows.items()])
    sys.stdout.flush()
    return begun


def _chosen(arguments: Namespace, package: str) -> tuple[Path, _Write]:
    """Return what is written to, and what does it. Raises UsageError."""
    if arguments.arrow is not None:
        return arguments.arrow, imported("arrow_tables", package, "tables").write_arrow
    if arguments.parquet is not None:
        folder, option = arguments.parquet, "--parquet"
        write = imported("arrow_tables", package, "tables").write_parquet
    else:
        folder, option, write = arguments.csv_tables, "--csv-tables", _write_csv
    if folder.is_file():
        raise UsageError(
            f"{folder} cannot be written: it is a file, and {option} takes a folder, "
            f"as in `{option} DIR {folder}`"
        )
    return folder, write


def _write_csv(
    recording: Recording, form: str, direction: Direction | None, folder: Path, seen: Counters
) -> dict[str, int]:
    rows = csv_written(counted(recording.entries(form, direction), seen), folder, recording.codec)
    return {str(folder / f"{name}.csv"): count for name, count in rows.items()}
