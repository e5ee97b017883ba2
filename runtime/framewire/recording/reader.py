"""Read a recording of a line, of any form, piece by piece."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

from ..codec.event_bytes import bytes_of
from ..codec.hextext import HexError, HexReader
from ..codec.protocol_codec import ProtocolCodec
from ..frame.direction import Direction
from .entry import Entry, RecordingError
from .file import QUIET
from .form import FORMS, TIMED_LINE, begun_as, blocks, log_lines
from .lines import logged, recorded, sender_of

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Protocol

    from ..codec.decoder import StreamDecoder
    from ..codec.noise import Noise
    from ..frame.message import Message
else:
    Protocol = object  # it is for type checkers alone

# What the module of a library exports is among it.
__all__ = ["FORMS", "Entry", "Readable", "RecordingError", "Recordings", "read"]


class Recordings:
    """The recordings of a protocol's line."""

    def __init__(self, codec: ProtocolCodec) -> None:
        self._codec = codec

    def read(
        self,
        source: str | os.PathLike[str] | Readable,
        *,
        form: str = "auto",
        direction: Direction | None = None,
    ) -> Iterator[Entry]:
        """Return each message and each piece of noise of a recording, in order.

            for entry in read("line.hex"):
                print(entry.time, entry.sender, entry.event)

        `source` is the name of a file, or a stream of bytes. `form` is one of FORMS. `direction` is
        the sender of bytes for which the recording names none. While it is read, raises
        RecordingError for content that makes no sense, and OSError for a file that cannot be read.

        A recording is read piece by piece, and never held as a whole. Each line of one says when
        its bytes came and from whom: bytes of two lines are never joined. Plain hex and raw bytes
        are one stream, and so is each way of a log of other programs, such as
        `12:01:02.123 -> 01 02`, `TX: 01 02`, a line of Python's logging, or a table with columns
        `tx` and `rx`; TX is what this end sends.
        """
        return read(self._codec, source, form, direction)


class Readable(Protocol):
    """A stream of bytes."""

    def read(self, size: int, /) -> bytes:
        """Return at most so many bytes; none at the end."""
        raise NotImplementedError


_CHUNK = 65536
_QUIET_LINE = re.compile(rf"^[ \t]{{0,80}}{QUIET}[ \t\r]{{0,80}}$", re.MULTILINE)
_TIME = re.compile(r"#+ *[0-9]{1,9}(?:\.[0-9]{1,9})? s, [^:\n]*: ")


def read(
    codec: ProtocolCodec,
    source: str | os.PathLike[str] | Readable,
    form: str,
    direction: Direction | None,
) -> Iterator[Entry]:
    """Return each message and each piece of noise of a recording, in order.

    All but `codec` is that of `read` of a library. Raises ValueError for a form that is none.
    """
    if form not in FORMS:
        raise ValueError(f"{form!r} is none of the forms {', '.join(FORMS)}")
    return _read(codec, source, form, direction)


def _read(
    codec: ProtocolCodec,
    source: str | os.PathLike[str] | Readable,
    form: str,
    direction: Direction | None,
) -> Iterator[Entry]:
    if isinstance(source, (str, os.PathLike)):
        with Path(source).open("rb") as stream:
            yield from _read(codec, stream, form, direction)
        return
    chunks = _chunks(source)
    begun, text = begun_as(lambda: next(chunks, b""), form)
    whole = chain([begun], chunks)
    if text:
        yield from _text(codec, blocks(whole), direction)
    else:
        yield from _streamed(codec, _raw(whole, codec.decoder(direction)), direction)


def _chunks(stream: Readable) -> Iterator[bytes]:
    # read1 returns what there is: on a live line nobody waits for a full buffer.
    read_some = getattr(stream, "read1", stream.read)
    while chunk := read_some(_CHUNK):
        yield chunk


def _streamed(
    codec: ProtocolCodec, decoded: Iterable[list[Message | Noise]], direction: Direction | None
) -> Iterator[Entry]:
    """Yield the entries of a stream, which says neither when its bytes came nor from whom."""
    offset = 0
    for events in decoded:
        for event in events:
            who = sender_of(codec, event) if direction is None else direction.sender
            yield Entry(event, who, offset, direction=direction)
            offset += len(bytes_of(event))


def _raw(chunks: Iterable[bytes], decoder: StreamDecoder) -> Iterator[list[Message | Noise]]:
    for chunk in chunks:
        yield decoder.feed(chunk)
    yield decoder.flush()


def _text(
    codec: ProtocolCodec, text: Iterator[str], direction: Direction | None
) -> Iterator[Entry]:
    """Yield the entries of text: it is a recording if its first line with bytes has a time."""
    before: list[str] = []
    for block in text:
        before.append(block)
        lines = (line for line in block.split("\n") if line.partition("#")[0].strip())
        first = next(lines, None)
        if first is not None:
            whole = chain(before, text)
            log = log_lines(first)
            if TIMED_LINE.match(first):
                yield from recorded(codec, whole, direction)
            elif log is not None:
                yield from logged(codec, whole, log, direction)
            else:
                decoded = _hex(whole, codec.decoder(direction))
                yield from _streamed(codec, decoded, direction)
            return


def _hex(text: Iterable[str], decoder: StreamDecoder) -> Iterator[list[Message | Noise]]:
    reader = HexReader()
    line = 1
    for block in text:
        timed = _TIME.search(block)
        end = len(block) if timed is None else block.rfind("\n", 0, timed.start()) + 1
        for is_after_quiet, part in enumerate(_QUIET_LINE.split(block[:end])):
            if is_after_quiet:
                yield decoder.flush()
            try:
                data = reader.feed(part)
            except HexError as error:
                raise _slip(error, line + part.count("\n", 0, error.at)) from None
            yield decoder.feed(data)
            line += part.count("\n")
        if timed is not None:
            problem = "it has a time and a sender, and the lines before it have none"
            raise RecordingError(f"line {line}: {problem}")
    try:
        data = reader.end()
    except HexError as error:
        raise _slip(error, line) from None
    yield decoder.feed(data) + decoder.flush()


def _slip(error: HexError, line: int) -> RecordingError:
    return RecordingError(
        f"line {line}: {error}; raw bytes need --format raw, in Python form='raw'"
    )
