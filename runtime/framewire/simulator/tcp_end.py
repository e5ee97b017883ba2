"""The board behind a TCP port, as a network-to-serial adapter shows it; one host at a time."""

from __future__ import annotations

import contextlib
import errno
import select
import socket

from .backlog import Backlog
from .waker import Waker

CHUNK = 4096
# More than a connection holds of what a host sent before it left.
_PARTING = 1 << 24
LOOPBACK = "127.0.0.1"


class TcpEnd:
    """A listening socket, on loopback by default."""

    def __init__(self, host: str = LOOPBACK, number: int = 0) -> None:
        self._host = host
        self._number = number
        self._waker = Waker()
        self._backlog = Backlog()
        self._listener: socket.socket | None = None
        self._guest: socket.socket | None = None

    @property
    def port(self) -> str:
        """The address, as pyserial takes it."""
        host = f"[{self._host}]" if ":" in self._host else self._host
        return f"socket://{host}:{self._number}"

    @property
    def host_baud(self) -> None:
        """None: a connection has no rate to set."""
        return None

    def plug_in(self) -> None:
        """Listen, on the same number as before if there was one."""
        self._waker.open()
        family = socket.AF_INET6 if ":" in self._host else socket.AF_INET
        listener = socket.socket(family, socket.SOCK_STREAM)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((self._host, self._number))
            listener.listen()
        except (OSError, TypeError) as error:
            listener.close()
            if isinstance(error, TypeError):  # as Python refuses it, before the system sees it
                raise OSError(errno.EINVAL, "no host has such a name") from None
            raise
        listener.setblocking(False)
        self._number = listener.getsockname()[1]
        self._listener = listener

    def unplug(self) -> None:
        """Close the connection, and stop listening."""
        self._hang_up()
        if self._listener is not None:
            _end(self._listener)
            self._listener = None
            self._waker.wake()

    def deliver(self, data: bytes) -> None:
        """Send as much as the connection takes; without one, the bytes are lost."""
        if self._guest is None and self._listener is not None:
            # A waiting host is accepted first, so that it receives everything from now on.
            self._admit(self._listener)
        if self._guest is None:
            return
        try:
            self._backlog.send(data, self._guest.send)
        except OSError:
            self._hang_up()

    def wait(self, seconds: float | None, *, listening: bool) -> None:
        """Wait for bytes of the host, for room for those to it, for a host, or to be woken."""
        guest, listener = self._guest, self._listener
        reading: list[Waker | socket.socket] = [self._waker]
        if listener is not None:
            reading.append(listener)
        if guest is not None and listening:
            reading.append(guest)
        writing = [guest] if guest is not None and self._backlog.data else []
        with contextlib.suppress(OSError, ValueError):  # unplugged in the meantime
            select.select(reading, writing, [], seconds)
        self._waker.clear()

    def receive(self) -> bytes:
        """Read the bytes that are there; then accept a waiting host, if the one before has left."""
        self.deliver(b"")
        found = self._read()
        # Of a guest who has sent more than that, it is not known yet whether he has left.
        if self._listener is not None and len(found) < CHUNK:
            found += self._admit(self._listener)
        return found

    def _read(self) -> bytes:
        found = b""
        while self._guest and len(found) < CHUNK and (data := self._receive(self._guest)):
            found += data
        return found

    def _receive(self, guest: socket.socket) -> bytes:
        try:
            data = guest.recv(CHUNK)
        except BlockingIOError:
            return b""
        except OSError:
            data = b""
        if not data:
            self._hang_up()
        return data

    def wake(self) -> None:
        """End a wait."""
        self._waker.wake()

    def close(self) -> None:
        """Unplug it."""
        self.unplug()
        self._waker.close()

    def _admit(self, listener: socket.socket) -> bytes:
        """Accept a waiting host; return what the one before has still sent, if he left for it."""
        left = b""
        with contextlib.suppress(OSError):
            caller, _ = listener.accept()
            # Whoever left before this one called may have done so after he was read.
            while self._guest is not None and len(left) < _PARTING and (more := self._read()):
                left += more
            if self._guest is not None:
                caller.close()
                return left
            self._guest = caller
            caller.setblocking(False)
            caller.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return left

    def _hang_up(self) -> None:
        guest, self._guest = self._guest, None
        self._backlog = Backlog()
        if guest is not None:
            _end(guest)


def _end(ended: socket.socket) -> None:
    """Close a socket at once, even if a thread waits for it: closing alone would wait for that."""
    with contextlib.suppress(OSError):
        ended.shutdown(socket.SHUT_RDWR)
    ended.close()
