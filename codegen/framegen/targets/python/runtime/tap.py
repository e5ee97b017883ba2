"""Shows what passes on a line: to `logging`, and to a file that the command `decode` reads back."""

from __future__ import annotations

import logging
from io import BufferedWriter, FileIO, TextIOWrapper
from typing import TYPE_CHECKING

from .noise import Noise
from .octets import spaced

if TYPE_CHECKING:
    from os import PathLike

    from .message import Message

logger = logging.getLogger(__package__)


class Tap:
    """Logs each frame at level DEBUG, and writes it to `trace`: a line of hex and a comment."""

    def __init__(self, name: str, trace: str | PathLike[str] | None = None) -> None:
        self._name = name
        self._trace: TextIOWrapper | None = None
        if trace is not None:
            # By the line, so that the file is whole up to the last frame whatever happens.
            file = BufferedWriter(FileIO(trace, "w"))
            self._trace = TextIOWrapper(file, encoding="ascii", line_buffering=True)
        self._began: float | None = None

    def sent(self, message: Message, now: float) -> None:
        """A frame was handed to the line."""
        self._tell(">", message.DIRECTION.sender, message, message.encode(), now)

    def received(self, event: Message | Noise, now: float) -> None:
        """A frame, or noise, came from the line."""
        if isinstance(event, Noise):
            self._tell("<", "noise", event.reason.value, event.data, now)
        else:
            self._tell("<", event.DIRECTION.sender, event, event.encode(), now)

    def _tell(self, way: str, who: str, what: Message | str, data: bytes, now: float) -> None:
        if logger.isEnabledFor(logging.DEBUG):
            logger.debug("%s %s %s | %s", self._name, way, what, spaced(data))
        if self._trace is None:
            return
        if self._began is None:
            self._began = now
        self._trace.write(f"{spaced(data)}  # {now - self._began:.6f} s, {who}: {what}\n")

    def close(self) -> None:
        """Closes the trace."""
        if self._trace is not None:
            self._trace.close()
            self._trace = None
