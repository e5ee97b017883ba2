"""Written apart: the independent board behind a port: a pty, TCP, or a call in virtual time."""

from __future__ import annotations

import contextlib
import os
import select
import socket
import threading
import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import TracebackType

    from typing_extensions import Self

    from tests.contract.independent.board import Board
    from tests.contract.independent.strangers import Stranger

CHUNK = 4096


class VirtualPort:
    """A transport in virtual time: a read moves the clock on, and nothing sleeps."""

    name = "independent board"

    def __init__(self, board: Board | Stranger) -> None:
        self.board: Board | Stranger = board
        self.now = 0.0
        self._closed = False

    def clock(self) -> float:
        """Return the time."""
        return self.now

    def read(self, timeout: float) -> bytes:
        """Return the bytes that have arrived, waiting up to `timeout` for the first."""
        # However short the wait, time goes on: or else a client that polls would stand still.
        until = self.now + max(timeout, 1e-6)
        while True:
            if self._closed:
                raise OSError("the port is closed")
            data = self.board.read(self.now)
            if data:
                return data
            event = self.board.next_event
            if event > until:
                self.now = until
                return b""
            self.now = max(self.now, event)

    def write(self, data: bytes) -> None:
        """Hand bytes to the wire."""
        if self._closed:
            raise OSError("the port is closed")
        self.board.write(data, self.now)

    def drain(self, timeout: float) -> None:
        """Let time pass until the board has received all."""
        until = self.now + timeout
        while self.board.in_transit and self.board.next_event <= until:
            self.now = max(self.now, self.board.next_event)
            self.board.write(b"", self.now)

    def close(self) -> None:
        """End its use."""
        self._closed = True

    def reopen(self) -> VirtualPort:
        """Return the same port, usable again."""
        self._closed = False
        return self


class StrangersPort(VirtualPort):
    """The port of a device that prints, which a host opens at any rate."""

    board: Stranger

    def __init__(self, stranger: Stranger) -> None:
        super().__init__(stranger)
        self.board = stranger

    def opened(self, rate: float) -> StrangersPort:
        """Return the same port, open at a rate."""
        self.reopen()
        self.board.opened(rate, self.now)
        return self


class Port:
    """A board in real time, served by a thread: `name` is what a host opens. Used in a `with`."""

    name: str

    def __init__(self, board: Board) -> None:
        self.board = board
        self._lock = threading.Lock()
        self._woken, self._wakes = socket.socketpair()
        self._woken.setblocking(False)
        self._closing = False
        self._thread = threading.Thread(target=self._serve, name="independent board", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._closing = True
        self._wakes.send(b"!")
        self._thread.join()
        self._close()
        self._woken.close()
        self._wakes.close()

    def receive(self, data: bytes) -> None:
        """Let the board receive bytes that no host at this port has sent."""
        with self._lock:
            self.board.write(data, time.monotonic())
        self._wakes.send(b"!")

    def report(self, command: int, group: int = 0, times: int = 0) -> None:
        """Let the board send an unsolicited report."""
        with self._lock:
            self.board.report(command, group, times, at=time.monotonic())
        self._wakes.send(b"!")

    def _serve(self) -> None:
        while not self._closing:
            with self._lock:
                now = time.monotonic()
                data = self.board.read(now)
                event = self.board.next_event
            if data:
                self._give(data)
            # A day stands for ever: select takes no infinity.
            left = min(86_400.0, max(0.0, event - time.monotonic()))
            ends = [self._woken, *self._ends()]
            ready, _, _ = select.select(ends, [], [], left)
            if self._woken in ready:
                self._woken.recv(CHUNK)
            if len(ready) > (self._woken in ready) and (data := self._take()):
                with self._lock:
                    self.board.write(data, time.monotonic())

    def _ends(self) -> list[socket.socket | int]:
        raise NotImplementedError

    def _take(self) -> bytes:
        raise NotImplementedError

    def _give(self, data: bytes) -> None:
        raise NotImplementedError

    def _close(self) -> None:
        raise NotImplementedError


class PtyPort(Port):
    """A pseudo-terminal. Linux and macOS."""

    def __init__(self, board: Board) -> None:
        import tty  # noqa: PLC0415 - there is none on Windows

        super().__init__(board)
        # The host's end stays open here, or else the pty would end whenever a host closes it.
        self._board_end, self._host_end = os.openpty()
        tty.setraw(self._host_end)
        os.set_blocking(self._board_end, False)
        self.name = os.ttyname(self._host_end)

    def _ends(self) -> list[socket.socket | int]:
        return [self._board_end]

    def _take(self) -> bytes:
        return os.read(self._board_end, CHUNK)

    def _give(self, data: bytes) -> None:
        # What a host leaves unread for too long is lost, as in the buffer of a serial port.
        with contextlib.suppress(BlockingIOError):
            os.write(self._board_end, data)

    def _close(self) -> None:
        os.close(self._board_end)
        os.close(self._host_end)


class TcpPort(Port):
    """TCP on this machine, for one host at a time; what is sent while there is none is lost."""

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._host: socket.socket | None = None
        self.name = f"socket://127.0.0.1:{self._listener.getsockname()[1]}"

    def _ends(self) -> list[socket.socket | int]:
        return [self._listener] if self._host is None else [self._host]

    def _take(self) -> bytes:
        if self._host is None:
            self._host, _ = self._listener.accept()
            self._host.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            return b""
        data = b""
        with contextlib.suppress(ConnectionError):
            data = self._host.recv(CHUNK)
        if not data:
            self._host.close()
            self._host = None
        return data

    def _give(self, data: bytes) -> None:
        if self._host is not None:
            with contextlib.suppress(ConnectionError):
                self._host.sendall(data)

    def _close(self) -> None:
        self._listener.close()
        if self._host is not None:
            self._host.close()
