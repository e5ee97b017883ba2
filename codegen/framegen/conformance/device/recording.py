"""The recording of a run: both directions of the line, written as it happens."""

from __future__ import annotations

from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from framewire.explain.refusals import TOO_SHORT
from framewire.recording.file import NOISE, RecordingFile

from framegen.conformance.device.step import Request
from framegen.conformance.language import fields
from framegen.model.codec import values_of
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from types import TracebackType

    from typing_extensions import Self

    from framegen.conformance.device.receiver import Received
    from framegen.conformance.device.step import Burst
    from framegen.model.model import Model


class Recording:
    """An open recording, or none for no path; a context manager. Raises Unusable."""

    def __init__(self, model: Model, path: Path | None) -> None:
        self._roles = model.roles
        self._path = path
        self._file: RecordingFile | None = None
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

    def begin(self, port: str) -> None:
        """Note what is recorded, and start its clock."""
        if self._file is not None:
            with self._failures_reported():
                self._file.begin(port)

    def note(self, text: str) -> None:
        """Note what is tried next."""
        if self._file is not None:
            with self._failures_reported():
                self._file.note(text)

    def sent(self, burst: Burst, now: float) -> None:
        """Note what is sent, a line for each frame; malformed bytes are marked as noise."""
        for piece in burst:
            if isinstance(piece, Request):
                self._write(piece.frame, now, self._roles.client, piece.text)
            else:
                self._write(piece.frame, now, f"{self._roles.client} {NOISE}", piece.reason)

    def received(self, received: Received) -> None:
        """Note an event of the device."""
        event = received.event
        if event.message is None:
            self._write(event.data, received.at, NOISE, event.reason)
            if event.reason == TOO_SHORT and self._file is not None:
                with self._failures_reported():
                    self._file.quiet()
            return
        said = fields(event.message, values_of(event.message, event.data))
        what = " ".join([event.message.name, *said])
        self._write(event.data, received.at, self._roles.device, what)

    def _write(self, data: bytes, at: float, who: str, what: str) -> None:
        if self._file is not None:
            with self._failures_reported():
                self._file.write(data, at, who, what)

    @contextmanager
    def _failures_reported(self) -> Iterator[None]:
        try:
            yield
        except FileExistsError as error:
            held, _, hint = str(error.strerror).partition("; ")
            raise Unusable(f"{self._path} cannot be written: {held}", hint=hint) from None
        except OSError as error:
            raise Unusable(f"{self._path} cannot be written: {error.strerror or error}") from None
