"""The interface of the board's end of a port, whatever the port is."""

from __future__ import annotations

from typing import Protocol


class PortEnd(Protocol):
    """The board's end of a pty, of a TCP connection, or of a transport in the same process."""

    @property
    def port(self) -> str:
        """The name that a host opens."""
        ...

    @property
    def host_baud(self) -> int | None:
        """The rate that a host has set; None if ports have none, or none has been set."""
        ...

    def plug_in(self) -> None:
        """Make the port; it may have another name than before."""
        ...

    def unplug(self) -> None:
        """Make the port vanish, in the middle of whatever is going on. Any number of times."""
        ...

    def deliver(self, data: bytes) -> None:
        """Hand bytes to the host. Never waits: unread bytes are lost, as on a serial line."""
        ...

    def wait(self, seconds: float | None, *, listening: bool) -> None:
        """Wait for bytes of the host, if `listening`; for room; for a host; or to be woken."""
        ...

    def receive(self) -> bytes:
        """Return the bytes of the host that are there, b"" for none. Never waits."""
        ...

    def wake(self) -> None:
        """End a wait of another thread."""
        ...

    def close(self) -> None:
        """Unplug it for good."""
        ...
