"""Write what a line carries to a file: a line of hex for each event, with a comment on it.

A trace of the client has the same form.
"""

from __future__ import annotations

from contextlib import contextmanager, suppress

from ..codec.event_bytes import bytes_of
from ..codec.noise import Noise
from ..recording.file import EITHER, NOISE, RecordingFile
from .events import names_of, sender_of
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path
    from types import TracebackType

    from typing_extensions import Self

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from ..frame.message import Message


class Recorder:
    """A recording in progress, or none at all; to be used in a `with`. Raises UsageError."""

    def __init__(self, path: Path | None, codec: ProtocolCodec) -> None:
        self._path = path
        self._codec = codec
        self._file: RecordingFile | None = None
        self._began = 0.0
        if path is not None:
            with self._failures_reported():
                self._file = RecordingFile(path)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._file is not None:
            # The earlier error is the one to report.
            with self._failures_reported() if kind is None else suppress(OSError):
                self._file.close()

    def begin(self, port: str, now: float) -> None:
        """Write where it was recorded, and when that began, by the clock of `now` and the day's."""
        self._began = now
        if self._file is not None:
            with self._failures_reported():
                self._file.begin(port)

    def record(
        self, events: Iterable[Message | Noise], direction: Direction | None, now: float
    ) -> None:
        """Write events that were received in a direction, or in either for None."""
        if self._file is None:
            return
        for event in events:
            who = sender_of(event, direction, self._codec)
            what = " or ".join(names_of(event, direction, self._codec))
            if isinstance(event, Noise):
                # Frames of the device are never sent to it, noise or not; all others are marked as
                # received.
                sender = EITHER if direction is None else direction.sender
                who = NOISE if direction is self._codec.received else f"{sender} {NOISE}"
                what = event.reason.value
            elif who != EITHER:
                what = repr(event)
            with self._failures_reported():
                self._file.write(bytes_of(event), now - self._began, who, what)

    def quiet(self) -> None:
        """Write that half a frame was given up: what follows is not its other half."""
        if self._file is not None:
            with self._failures_reported():
                self._file.quiet()

    @contextmanager
    def _failures_reported(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            problem = f"{self._path} cannot be written: {error.strerror or error}"
            raise UsageError(problem) from None
