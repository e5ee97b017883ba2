"""A capture that is read twice, whatever holds it."""

from __future__ import annotations

import os
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Any

from ..source import in_memory, stream_in
from .part import Part

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from ..source import Readable, Source

_CHUNK = 1 << 20


@contextmanager
def rereadable(source: Source) -> Iterator[Callable[[], Source]]:
    """Give a function that returns the capture from its beginning, each time with the same bytes.

    A stream is copied to disk. A file that grows is read as far as it goes now.
    """
    if isinstance(source, (str, os.PathLike)):
        with Path(source).open("rb", buffering=0) as stream:
            if stream.seekable():
                yield _from_beginning(stream)
                return
            with _copied(stream) as copy:
                yield copy
        return
    if in_memory(source) is None:
        with _copied(stream_in(source)) as copy:
            yield copy
    else:
        yield lambda: source


@contextmanager
def _copied(stream: Readable) -> Iterator[Callable[[], Source]]:
    with TemporaryFile() as copy:
        while data := stream.read(_CHUNK):
            copy.write(data)
        yield _from_beginning(copy)


def _from_beginning(stream: Any) -> Callable[[], Source]:
    size = stream.seek(0, os.SEEK_END)

    def again() -> Source:
        stream.seek(0)
        return Part(stream, size)

    return again
