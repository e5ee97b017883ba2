"""Captures as pieces of work that need nothing of each other: a stretch of a file each."""

from __future__ import annotations

import os
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from ...frame.visible import visible
from ...recording.entry import RecordingError
from ..files.part import part_of
from ..reader import BLOCK, batches
from ..schema import schemas_of
from ..source import opened
from ..tables import gathered
from .capture_files import capture_files
from .cuts import safe_cuts

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from typing import TypeVar

    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.direction import Direction
    from ..reader import Batches
    from ..tables import Tables

    _Piece = TypeVar("_Piece", bound="Piece")

PIECE = 1 << 26
"""About how many bytes of a capture are one piece."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A stretch of a capture, which holds whole events: what `Piece` of each library is made of."""

    # A piece is of a library, so that whatever process it is sent to reads it with the same.
    codec: ClassVar[ProtocolCodec]

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
        return gathered(schemas_of(self.codec), self.read_batches())

    def read_batches(self, *, block: int = BLOCK) -> Iterator[Batches]:
        """Yield its tables stretch by stretch; offsets are those of the whole capture.

        Raises OSError for a file that cannot be read, and RecordingError for one that makes no
        sense, or that has changed since it was scanned.
        """
        self.refuse_changed()
        with part_of(self.path, self.start, self.end) as stream:
            yield from batches(self.codec, stream, self.form, self.direction, block, self.start)
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
    kind: type[_Piece],
    paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    size: int,
    form: str,
    direction: Direction | None,
) -> list[_Piece]:
    """Return the pieces of captures, of the kind of a library; a raw capture is cut by `size`."""
    given = [paths] if isinstance(paths, (str, os.PathLike)) else [*paths]
    return [
        piece
        for capture, path in capture_files(given).items()
        for piece in _pieces(kind, str(path), capture, size, form, direction)
    ]


def _pieces(
    kind: type[_Piece], path: str, capture: str, size: int, form: str, direction: Direction | None
) -> Iterator[_Piece]:
    try:
        stamp = stamp_of(path)
        with opened(path, form) as begun:
            is_text = begun.is_text
        cuts = [] if is_text else safe_cuts(kind.codec, path, size, direction)
    except OSError:
        yield kind(path, capture, 0, 0, form, direction, None)
        return
    bounds = [0, *(cut for cut in cuts if cut < stamp[0]), stamp[0]]
    for start, end in pairwise(bounds):
        yield kind(path, capture, start, end, "hex" if is_text else "raw", direction, stamp)
