"""A part of a file, read as a stream of its own."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator


class Part:
    """The bytes of a file from where it stands, and no more than so many."""

    def __init__(self, stream: BinaryIO, size: int) -> None:
        self._stream = stream
        self._left = size

    def read(self, size: int, /) -> bytes:
        """Return at most so many bytes; none at the end."""
        data = self._stream.read(min(size, self._left))
        self._left -= len(data)
        return data


@contextmanager
def part_of(path: str | os.PathLike[str], start: int, end: int) -> Iterator[Part]:
    """Open the bytes of a file from one place to another."""
    with Path(path).open("rb", buffering=0) as stream:
        stream.seek(start)
        yield Part(stream, end - start)
