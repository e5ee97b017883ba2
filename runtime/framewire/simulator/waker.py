"""A way to end a `select` that another thread waits in."""

from __future__ import annotations

import contextlib
import socket


class Waker:
    """A pair of sockets, since that is what `select` takes on every system."""

    def __init__(self) -> None:
        self._pair: tuple[socket.socket, socket.socket] | None = None

    def open(self) -> None:
        """Make the pair. Any number of times."""
        if self._pair is None:
            self._pair = socket.socketpair()
            for end in self._pair:
                end.setblocking(False)

    def fileno(self) -> int:
        """Return the descriptor for `select` to wait for; -1 while it is not open."""
        return -1 if self._pair is None else self._pair[0].fileno()

    def wake(self) -> None:
        """End the wait, now or as soon as it begins."""
        with contextlib.suppress(OSError):  # full: it has been woken more than enough
            if self._pair is not None:
                self._pair[1].send(b"\0")

    def clear(self) -> None:
        """Forget that it was woken."""
        with contextlib.suppress(OSError):
            if self._pair is not None:
                self._pair[0].recv(4096)

    def close(self) -> None:
        """Close both ends."""
        for end in self._pair or ():
            end.close()
        self._pair = None
