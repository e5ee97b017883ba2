"""A transport whose every failure is a TransportError, whoever wrote it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .link_errors import DisconnectedError, TransportError

if TYPE_CHECKING:
    from collections.abc import Callable

    from .transport import Transport


class Guarded:
    """Passes everything on, and turns the operating system's errors into those of this library."""

    def __init__(self, transport: Transport) -> None:
        self._transport = transport
        self.name = str(getattr(transport, "name", type(transport).__name__))

    def read(self, timeout: float) -> bytes:
        """As Transport.read."""
        try:
            return self._transport.read(timeout)
        except TransportError:
            raise
        except OSError as error:
            raise self._lost(error) from error

    def write(self, data: bytes) -> None:
        """As Transport.write."""
        try:
            self._transport.write(data)
        except TransportError:
            raise
        except OSError as error:
            raise self._lost(error) from error

    def drain(self, timeout: float) -> None:
        """As Transport.drain."""
        try:
            self._transport.drain(timeout)
        except TransportError:
            raise
        except OSError as error:
            raise self._lost(error) from error

    def close(self) -> None:
        """As Transport.close; what is gone cannot be closed any better."""
        try:
            self._transport.close()
        except OSError:
            return

    @property
    def reopen(self) -> Callable[[], Transport]:
        """What opens the same line anew. Raises TypeError where the transport does not know how."""
        reopen: Callable[[], Transport] | None = getattr(self._transport, "reopen", None)
        if reopen is None:
            raise TypeError(f"{self.name} has no method reopen(), and cannot be opened again")
        return reopen

    def _lost(self, error: OSError) -> DisconnectedError:
        advice = "see to the cable and the power, then reconnect()"
        return DisconnectedError(self.name, f"the line was lost ({error})", advice)
