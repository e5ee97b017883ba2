"""Tables as Parquet files: one each, of row groups that fit into memory."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pyarrow as pa
import pyarrow.parquet as pq

from ...recording.table_folder import UNFINISHED, TableFolder
from .write_error import naming

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Sequence

    from ..reader import Batches

# A row group is written when its table holds so much, and the largest when all do together.
_ROW_GROUP = 1 << 24
_ALL_HELD = 1 << 26


class ParquetFiles:
    """The files of some tables that are being written, as FOLDER/<Table> and a suffix."""

    def __init__(self, folder: Path, suffix: str = ".parquet") -> None:
        self._folder = folder
        self._suffix = suffix
        self._writers: dict[str, Any] = {}
        self._held: dict[str, list[pa.RecordBatch]] = {}
        self._sizes: dict[str, int] = {}
        self.rows: dict[str, int] = {}

    def add(self, batches: Batches) -> None:
        """Take in what came next."""
        for name, batch in batches.items():
            self._held.setdefault(name, []).append(batch)
            self._sizes[name] = self._sizes.get(name, 0) + batch.nbytes
            self.rows[name] = self.rows.get(name, 0) + batch.num_rows
            if self._sizes[name] >= _ROW_GROUP:
                self._write(name)
        while sum(self._sizes.values()) >= _ALL_HELD:
            self._write(max(self._sizes, key=self._sizes.__getitem__))

    def end(self) -> None:
        """Write what is held, and close the files."""
        for name in [*self._held]:
            self._write(name)
        for name, writer in self._writers.items():
            with naming(self._path(name)):
                writer.close()
        self._writers.clear()

    def discard(self) -> None:
        """Close the files and remove them."""
        for writer in self._writers.values():
            # What cannot be written, cannot be finished either.
            with suppress(OSError, pa.ArrowException):
                writer.close()
        for name in self.rows:
            with suppress(OSError, pa.ArrowException):
                self._path(name).unlink(missing_ok=True)
        self._writers.clear()

    def _write(self, name: str) -> None:
        table = pa.Table.from_batches(self._held.pop(name))
        del self._sizes[name]
        path = self._path(name)
        with naming(path):
            if name not in self._writers:
                self._writers[name] = _writer(path, table.schema)
            self._writers[name].write_table(table)

    def _path(self, name: str) -> Path:
        return self._folder / f"{name}{self._suffix}"


def _writer(path: Path, schema: pa.Schema) -> Any:
    # Dictionaries pay for names alone: numbers are smaller, and quicker, as they are. What is asked
    # for by its bounds is where and when.
    names: Any = [each.name for each in schema if pa.types.is_dictionary(each.type)]
    bounded: Any = ["offset", "time", "clock"]
    return pq.ParquetWriter(
        str(path),
        schema,
        compression="zstd",
        use_dictionary=names,
        write_statistics=bounded,
        column_encoding={"offset": "DELTA_BINARY_PACKED"},
    )


def parquet_written(
    names: Sequence[str], batches: Iterable[Batches], folder: str | os.PathLike[str]
) -> dict[str, int]:
    """Write tables as FOLDER/<Table>.parquet, and return the rows of each; `names` are all of them.

    The folder is made, or holds nothing but such files, which are replaced. Raises FileExistsError
    if it holds something else. Whatever goes wrong, no file is half-written.
    """
    target = TableFolder(names, Path(folder), ".parquet")
    files = ParquetFiles(Path(folder), f".parquet{UNFINISHED}")
    with target.replaced() as written:
        try:
            for made in batches:
                files.add(made)
            files.end()
        except BaseException:
            files.discard()
            raise
        written.update(files.rows)
    return files.rows
