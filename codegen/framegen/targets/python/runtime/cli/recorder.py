"""Writes what a line carries to a file: a line of hex for each event, and in a comment what it is.

`decode` reads the hex, and `replay` the times and the senders as well. A trace of the client has
the same form.
"""

from __future__ import annotations

import time

from ..exchanges import RECEIVED
from ..noise import Noise
from ..octets import spaced
from .events import EITHER, NOISE, bytes_of, names_of, sender_of
from .hextext import QUIET
from .unusable import UnusableError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path
    from types import TracebackType
    from typing import TextIO

    from typing_extensions import Self

    from ..direction import Direction
    from ..message import Message


class Recorder:
    """A file in the making, or none at all; to be used in a `with`. Raises UnusableError."""

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._file: TextIO | None = None
        self._began = 0.0
        if path is not None:
            try:
                # A name may hold anything, and a line with anything but ASCII is taken for no hex.
                self._file = path.open("w", encoding="ascii", errors="backslashreplace")
            except OSError as error:
                raise self._unwritable(error) from None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._file is not None:
            try:
                self._file.close()
            except OSError as failure:
                if kind is None:
                    raise self._unwritable(failure) from None

    def begin(self, port: str, now: float) -> None:
        """Notes where it was recorded, and when that began, by the clock of `now` and the day's."""
        self._began = now
        day = time.strftime("%Y-%m-%d %H:%M:%S %z")
        self._write(f"# recorded of {port!r} from {day} on\n")

    def record(
        self, events: Iterable[Message | Noise], direction: Direction | None, now: float
    ) -> None:
        """Writes what was heard in a direction, or in either for None."""
        for event in events if self._file is not None else ():
            who, what = sender_of(event, direction), " or ".join(names_of(event, direction))
            if isinstance(event, Noise):
                # What the board sends is never sent to it, noise or no; all else is for the reader.
                sender = EITHER if direction is None else direction.sender
                who = NOISE if direction is RECEIVED is not None else f"{sender} {NOISE}"
                what = event.reason.value
            elif who != EITHER:
                what = repr(event)
            self._write(f"{spaced(bytes_of(event))}  # {now - self._began:.6f} s, {who}: {what}\n")

    def quiet(self) -> None:
        """Notes that half a frame was given up: what follows is not its other half."""
        self._write(f"{QUIET}\n")

    def _write(self, text: str) -> None:
        if self._file is None:
            return
        try:
            self._file.write(text)
            # By the line, so that the file is whole up to the last frame whatever happens.
            self._file.flush()
        except OSError as error:
            raise self._unwritable(error) from None

    def _unwritable(self, error: OSError) -> UnusableError:
        return UnusableError(f"{self._path} cannot be written: {error.strerror or error}")
