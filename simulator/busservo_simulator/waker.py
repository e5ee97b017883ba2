"""Ends a `select` that another thread waits in."""

from __future__ import annotations

import contextlib
import socket


class Waker:
    """A pair of sockets, since that is what `select` takes on every system."""

    def __init__(self) -> None:
        self._near, self._far = socket.socketpair()
        self._near.setblocking(False)
        self._far.setblocking(False)

    def fileno(self) -> int:
        """What `select` is to wait for."""
        return self._near.fileno()

    def wake(self) -> None:
        """Ends the wait, now or as soon as it begins."""
        with contextlib.suppress(OSError):  # full: it has been woken more than enough
            self._far.send(b"\0")

    def clear(self) -> None:
        """Forgets that it was woken."""
        with contextlib.suppress(OSError):
            self._near.recv(4096)

    def close(self) -> None:
        """Gives both ends back."""
        self._near.close()
        self._far.close()
