"""Captures as pieces of work that need nothing of each other: a stretch of a file each."""

from __future__ import annotations

import os
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from ..._frame.visible import visible
from ..._recording.entry import RecordingError
from ..files.part import part_of
from ..reader import BLOCK, batches
from ..source import opened
from ..tables import gathered
from .capture_files import capture_files
from .cuts import safe_cuts

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from ..._frame.direction import Direction
    from ..reader import Batches
    from ..tables import Tables

PIECE = 1 << 26
"""About how many bytes of a capture are one piece."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A stretch of a capture, from its byte `start` to `end`, which holds whole events.

    `path` is absolute; `capture` is the name below the folder that was scanned. `form` is "raw" or
    "hex", "auto" if the file could not be read. `stamp` is the size of the file and the time, in
    nanoseconds, at which it was written last: a file that has another when it is read has changed.
    """

    path: str
    capture: str
    start: int
    end: int
    form: str
    direction: Direction | None
    stamp: tuple[int, int] | None

    @property
    def size(self) -> int:
        """How many bytes it has."""
        return self.end - self.start

    def read(self) -> Tables:
        """Read it into memory; offsets are those of the whole capture. Raises as `read_batches`."""
        return gathered(self.read_batches())

    def read_batches(self, *, block: int = BLOCK) -> Iterator[Batches]:
        """Yield its tables stretch by stretch; offsets are those of the whole capture.

        Raises OSError for a file that cannot be read, and RecordingError for one that makes no
        sense, or that has changed since it was scanned.
        """
        self.refuse_changed()
        with part_of(self.path, self.start, self.end) as stream:
            yield from batches(stream, self.form, self.direction, block, self.start)
        self.refuse_changed()

    def refuse_changed(self) -> None:
        """Raise OSError if the file cannot be read, RecordingError if it is not what it was."""
        if self.stamp is None:
            with Path(self.path).open("rb"):
                pass
        if stamp_of(self.path) != self.stamp:
            raise RecordingError("the file has changed since it was scanned: scan again")

    def __str__(self) -> str:
        return f"{visible(self.capture)}[{self.start}:{self.end}]"


def stamp_of(path: str) -> tuple[int, int]:
    """Return the size of a file, and when it was written last. Raises OSError."""
    status = Path(path).stat()
    return status.st_size, status.st_mtime_ns


def scan(
    paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    *,
    size: int = PIECE,
    form: str = "auto",
    direction: Direction | None = None,
) -> list[Piece]:
    """Return the pieces of captures: independent work for any number of processes or machines.

    `paths` are files, patterns such as "captures/*.bin", and folders, or one of these. Of a folder
    all files are taken, and of those in it, but hidden ones and datasets. Raw captures are cut
    about every `size` bytes, where any decoder holds nothing; text recordings are one piece each.
    `form` and `direction` are as in `read`. A file that cannot be read, or is not there, is a piece
    whose work says so.

    Links are followed to files of the folder alone, and not to folders: a link that leads out of
    what is scanned is no capture of it, unless it is named itself.

    Captures are named below the folder that is scanned, or that holds all that is scanned.
    """
    given = [paths] if isinstance(paths, (str, os.PathLike)) else [*paths]
    return [
        piece
        for capture, path in capture_files(given).items()
        for piece in _pieces(str(path), capture, size, form, direction)
    ]


def _pieces(
    path: str, capture: str, size: int, form: str, direction: Direction | None
) -> Iterator[Piece]:
    try:
        stamp = stamp_of(path)
        with opened(path, form) as begun:
            is_text = begun.is_text
        cuts = [] if is_text else safe_cuts(path, size, direction=direction)
    except OSError:
        yield Piece(path, capture, 0, 0, form, direction, None)
        return
    bounds = [0, *(cut for cut in cuts if cut < stamp[0]), stamp[0]]
    for start, end in pairwise(bounds):
        yield Piece(path, capture, start, end, "hex" if is_text else "raw", direction, stamp)
