"""A transport whose every failure is a TransportError, whoever wrote it."""

from __future__ import annotations

from functools import partial

from .link_errors import ClosedError, DisconnectedError, TransportError, errno_of

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeVar

    from .log import Log
    from .transport import Transport

    _Result = TypeVar("_Result")


class ErrorMapping:
    """A transport that passes everything on, and turns exceptions into TransportError."""

    def __init__(self, transport: Transport, log: Log) -> None:
        self._transport = transport
        self._log = log
        self.name = str(getattr(transport, "name", type(transport).__name__))
        self.largest_frame: int | None = getattr(transport, "largest_frame", None)
        # What has a function called when there is something to read, without anybody waiting.
        self.on_readable: Callable[[Callable[[], object]], object] | None = getattr(
            transport, "on_readable", None
        )
        self._closed = False

    def read(self, timeout: float) -> bytes:
        """Read, as Transport.read does."""
        return self._mapped(partial(self._transport.read, timeout))

    def write(self, data: bytes) -> None:
        """Write, as Transport.write does."""
        self._mapped(partial(self._transport.write, data))

    def drain(self, timeout: float) -> None:
        """Drain, as Transport.drain does."""
        self._mapped(partial(self._transport.drain, timeout))

    def close(self) -> None:
        """Close, as Transport.close does; a failure to close a lost line is ignored."""
        self._closed = True
        try:
            self._mapped(self._transport.close)
        except TransportError as error:
            self._log().debug("%s could not be closed: %s", self.name, error)

    @property
    def reopen(self) -> Callable[[], ErrorMapping]:
        """A function that reopens the line. Raises TypeError if the transport cannot."""
        reopen: Callable[[], Transport] | None = getattr(self._transport, "reopen", None)
        if reopen is None:
            raise TypeError(f"{self.name} has no method reopen(), and cannot be opened again")
        return lambda: ErrorMapping(self._mapped(reopen), self._log)

    def _mapped(self, call: Callable[[], _Result]) -> _Result:
        try:
            return call()
        except TransportError:
            raise
        except Exception as error:
            if self._closed:
                # A read in progress when the transport was closed may fail in any way.
                raise ClosedError(self.name, "it has been closed", "open it again") from error
            raise self._failed(error) from error

    def _failed(self, error: Exception) -> TransportError:
        if isinstance(error, OSError):
            advice = "check the cable and the power, then reconnect()"
            happened = f"the line was lost ({error})"
            return DisconnectedError(self.name, happened, advice, errno_of(error))
        # Whoever waits for the line must hear of it, in whichever thread it happened.
        self._log().error("%s failed", self.name, exc_info=error)
        happened = f"its transport failed ({error!r})"
        return TransportError(self.name, happened, "mend the transport")
