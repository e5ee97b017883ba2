"""Pieces of captures into a dataset of Parquet files, each piece by itself."""

from __future__ import annotations

import shutil
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import pyarrow as pa

from ...frame.visible import visible
from ...recording.entry import RecordingError
from ..files.parquet import ParquetFiles
from .manifest import Manifest, ManifestError

if TYPE_CHECKING:
    import os

    from .pieces import Piece

_MEGABYTE = 1e6


@dataclass(frozen=True, slots=True)
class Report:
    """What became of one piece.

    `rows` are those of each table, and `seconds` the time that it took. `is_new` is False if the
    piece was in the dataset already. `error` says what was wrong; then it is still to be done.
    """

    piece: Piece
    rows: dict[str, int] = field(default_factory=dict)
    seconds: float = 0.0
    is_new: bool = False
    error: str | None = None

    def __str__(self) -> str:
        if self.error is not None:
            return f"{self.piece}: error: {visible(self.error)}"
        rows = f"{self.piece}: {sum(self.rows.values())} rows"
        if not self.is_new:
            return f"{rows}, done before"
        return f"{rows}, {self.piece.size / _MEGABYTE:.1f} MB in {self.seconds:.1f} s"


def archive(piece: Piece, folder: str | os.PathLike[str]) -> Report:
    """Write a piece into a dataset, as FOLDER/<Table>/capture=<name>/<start>-<digits>.parquet.

    Pieces need nothing of each other, and may be written at the same time, by any processes that
    see both folders. A piece that is in the dataset is not written again, so that work that was
    stopped is done by doing all of it once more. Of a file that has changed, and has been scanned
    again, the old pieces are removed. Whatever is wrong with a capture, or with the disk, is in the
    report, and is not raised.
    """
    begun = perf_counter()
    manifest = Manifest(Path(folder), piece)
    try:
        piece.refuse_changed()
        rows = manifest.rows
        is_new = rows is None
        if rows is None:
            rows = _written(piece, manifest)
    except (OSError, RecordingError, ManifestError, pa.ArrowException) as error:
        done = _rows_done(manifest)
        if done is not None:
            # Another has written it at the same time, and removed what is not needed any more.
            return Report(piece, done)
        return Report(piece, seconds=perf_counter() - begun, error=_said(piece, error))
    return Report(piece, rows, perf_counter() - begun, is_new)


def _written(piece: Piece, manifest: Manifest) -> dict[str, int]:
    unfinished = manifest.begin()
    files = ParquetFiles(unfinished)
    try:
        for made in piece.read_batches():
            files.add(made)
        files.end()
        manifest.finish(unfinished, files.rows)
    except BaseException:
        files.discard()
        shutil.rmtree(unfinished, ignore_errors=True)
        raise
    return files.rows


def _rows_done(manifest: Manifest) -> dict[str, int] | None:
    try:
        return manifest.rows
    except (OSError, ManifestError):
        return None


def _said(piece: Piece, error: Exception) -> str:
    """Return what went wrong, and where."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename or piece.path}: {error.strerror}"
    return str(error) if isinstance(error, ManifestError) else f"{piece.path}: {error}"
