"""The trace of a line: to `logging`, and to a recording that `recordings` reads back."""

from __future__ import annotations

from ..codec.noise import Noise
from ..frame.bytes_like import format_hex
from ..recording.file import NOISE, RecordingFile

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from os import PathLike

    from ..frame.message import Message
    from ..line.log import Log


class Trace:
    """A trace that puts each frame in `log`, at level DEBUG, and records it in the file `trace`.

    Raises OSError if that cannot be written: FileExistsError if it holds a recording.
    """

    def __init__(self, log: Log, name: str, trace: str | PathLike[str] | None = None) -> None:
        self._log = log
        self._name = name
        self._trace = None if trace is None else RecordingFile(trace)
        self._began: float | None = None

    def sent(self, message: Message, now: float) -> None:
        """Record a frame that was handed to the line."""
        self._tell(">", message.DIRECTION.sender, message, message.encode(), now)

    def received(self, event: Message | Noise, now: float) -> None:
        """Record a frame, or noise, that came from the line."""
        if isinstance(event, Noise):
            self._tell("<", NOISE, event.reason.value, event.data, now)
        else:
            self._tell("<", event.DIRECTION.sender, event, event.encode(), now)

    def quiet(self) -> None:
        """Record a silence within a frame: what comes next is not the rest of it."""
        if self._trace is not None:
            self._trace.quiet()

    def _tell(self, way: str, who: str, what: Message | str, data: bytes, now: float) -> None:
        if self._log.shows_frames():
            self._log().debug("%s %s %s | %s", self._name, way, what, format_hex(data))
        if self._trace is None:
            return
        if self._began is None:
            self._began = now
            self._trace.begin(self._name)
        self._trace.write(data, now - self._began, who, what)

    def close(self) -> None:
        """Close the trace."""
        if self._trace is not None:
            self._trace.close()
            self._trace = None
