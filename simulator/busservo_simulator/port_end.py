"""What every way of reaching the board has in common: the board's end of a port."""

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
        """The rate that a host has set; None where ports have none, or none has been set."""
        ...

    def plug_in(self) -> None:
        """Makes the port; it may have another name than before."""
        ...

    def unplug(self) -> None:
        """Makes the port vanish, in the middle of whatever is going on. Any number of times."""
        ...

    def deliver(self, data: bytes) -> None:
        """Hands bytes to the host. Never waits: what nobody reads is lost, as on a serial line."""
        ...

    def wait(self, seconds: float | None, *, listening: bool) -> None:
        """Waits for bytes of the host, if `listening`; for room; for a host; or to be woken."""
        ...

    def receive(self) -> bytes:
        """The bytes of the host that are there, b"" for none. Never waits."""
        ...

    def wake(self) -> None:
        """Ends a wait that another thread is in."""
        ...

    def close(self) -> None:
        """Unplugs it for good."""
        ...
