"""The bytes of a capture, whatever holds them: a file, a stream, bytes or a memory map."""

from __future__ import annotations

import io
import os
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

import numpy as np

from ..recording.form import FORMS, begun_as

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .events import Bytes


class Readable(Protocol):
    """A stream of bytes."""

    def read(self, size: int, /) -> bytes:
        """Return at most so many bytes; none at the end."""
        raise NotImplementedError


Source: TypeAlias = "str | os.PathLike[str] | bytes | bytearray | memoryview | Bytes | Readable"
"""What holds a capture: the name of a file; bytes, a memory map or an array; or a stream."""

_LOOKED_AT = 65536


class Capture:
    """A capture that is open: its bytes in order, and whether they are text."""

    def __init__(self, stream: Readable, form: str) -> None:
        self._read = getattr(stream, "read1", stream.read)
        self._begun, self.is_text = begun_as(lambda: self._read(_LOOKED_AT), form)

    def read(self, size: int, /) -> bytes:
        """Return at most so many bytes; none at the end."""
        if self._begun:
            begun, self._begun = self._begun[:size], self._begun[size:]
            return begun
        data: bytes = self._read(size)
        return data

    def blocks(self, size: int) -> Iterator[Bytes]:
        """Yield the bytes, so many at once; the last are fewer, or none."""
        while True:
            pieces, left = [], size
            while left and (more := self.read(left)):
                pieces.append(more)
                left -= len(more)
            yield np.frombuffer(pieces[0] if len(pieces) == 1 else b"".join(pieces), np.uint8)
            if left:
                return


class _Held:
    """Bytes that are held already, read as a stream; never copied as a whole."""

    def __init__(self, held: memoryview) -> None:
        self._left = held

    def read(self, size: int, /) -> bytes:
        """Return at most so many bytes; none at the end."""
        some, self._left = self._left[:size], self._left[size:]
        return bytes(some)


@contextmanager
def opened(source: Source, form: str) -> Iterator[Capture]:
    """Open a capture. Raises ValueError for another form, OSError and TypeError."""
    if form not in FORMS:
        raise ValueError(f"{form!r} is none of the forms {', '.join(FORMS)}")
    if isinstance(source, (str, os.PathLike)):
        with Path(source).open("rb", buffering=0) as stream:
            yield Capture(stream, form)
        return
    held = in_memory(source)
    yield Capture(stream_in(source) if held is None else _Held(held), form)


def in_memory(source: Any) -> memoryview | None:
    """Return the bytes of a capture that is held; None for any other."""
    try:
        whole = memoryview(source)
    except TypeError:
        return None
    if not whole.c_contiguous:
        raise TypeError("the array is no run of bytes as it lies in memory: give a copy of it")
    return whole.cast("B")


def stream_in(source: Any) -> Readable:
    """Return a capture that is a stream of bytes. Raises TypeError for anything else."""
    if not callable(getattr(source, "read", None)):
        kind = type(source).__name__
        raise TypeError(f"a file name, bytes or a stream of bytes expected, not {kind}")
    if isinstance(source, io.TextIOBase):
        raise TypeError("a stream of bytes expected, not of text: open the file with 'rb'")
    stream: Readable = source
    return stream
