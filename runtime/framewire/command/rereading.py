"""Make a recording readable more than once, whatever it comes from."""

from __future__ import annotations

from contextlib import contextmanager
from tempfile import TemporaryFile

from .recording import Recording

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

_CHUNK = 65536


@contextmanager
def rereadable(recording: Recording) -> Iterator[Recording]:
    """Return the recording itself, or a copy on disk of one that comes from a pipe."""
    if recording.again:
        yield recording
        return
    with TemporaryFile() as copy:
        while data := recording.read(_CHUNK):
            copy.write(data)
        yield Recording(copy, recording.name, recording.codec)
