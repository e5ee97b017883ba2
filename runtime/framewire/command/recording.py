"""The input of the verbs, a file or standard input: opened, read as it comes, errors reported."""

from __future__ import annotations

import sys
import time
from contextlib import contextmanager

from ..recording.entry import RecordingError
from ..recording.reader import read
from .progress import PROGRESS_INTERVAL, Progress
from .progress_bar import progress_bar
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from typing import BinaryIO

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from ..recording.entry import Entry


class Recording:
    """A recording that is open; `again` says whether it can be read more than once.

    Output so far is flushed before it waits for more. If that leaves a terminal empty for long, it
    shows there how far it has come; `is_quiet` says that nothing is printed until all is read.
    """

    is_quiet = False

    def __init__(self, stream: BinaryIO, name: str, codec: ProtocolCodec) -> None:
        self.name = name
        self.codec = codec
        self._stream = stream
        self._read = getattr(stream, "read1", stream.read)
        self.again = stream.seekable()
        self._size = stream.seek(0, 2) if self.again else 0
        self._done = 0
        self._progress = Progress(sys.stderr)
        self._began = self._shown = time.monotonic()

    def entries(self, form: str, direction: Direction | None) -> Iterator[Entry]:
        """Yield the entries, from the beginning on. Raises UsageError."""
        with self.from_the_beginning():
            yield from read(self.codec, self, form, direction)

    @contextmanager
    def from_the_beginning(self) -> Iterator[None]:
        """Go back to the beginning, and have what reads it raise UsageError for its content."""
        self._done = 0
        self._began = time.monotonic()
        if self.again:
            self._stream.seek(0)
        try:
            yield
        except RecordingError as error:
            raise UsageError(f"{self.name}, {error}") from None
        finally:
            self._progress.clear()

    def read(self, size: int) -> bytes:
        """Return what there is, at most `size` bytes. Raises UsageError."""
        sys.stdout.flush()
        try:
            data: bytes = self._read(size)
        except OSError as error:
            raise _unreadable(self.name, error) from None
        self._done += len(data)
        now = time.monotonic()
        if now - self._shown >= PROGRESS_INTERVAL and (self.is_quiet or not sys.stdout.isatty()):
            self._shown = now
            bar = progress_bar(self._done, self._size, now - self._began)
            self._progress.show(f"{bar}: {self.name}")
        return data


@contextmanager
def opened(path: Path, codec: ProtocolCodec) -> Iterator[Recording]:
    """Open the file of that name, or standard input for `-`. Raises UsageError."""
    name = "standard input" if str(path) == "-" else str(path)
    if name != str(path) and sys.stdin is None:
        raise UsageError("standard input is closed; name a file")
    try:
        stream = path.open("rb") if name == str(path) else sys.stdin.buffer
    except OSError as error:
        raise _unreadable(name, error) from None
    try:
        yield Recording(stream, name, codec)
    finally:
        if name == str(path):
            stream.close()


def _unreadable(name: str, error: OSError) -> UsageError:
    return UsageError(f"{name} cannot be read: {error.strerror or error}")
