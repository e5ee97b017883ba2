"""A serial port served over RFC 2217, by pyserial's own half of that protocol."""

from __future__ import annotations

import socket
import threading
from typing import TYPE_CHECKING

import serial
from serial.rfc2217 import PortManager

from tests.timeouts import GENEROUS

if TYPE_CHECKING:
    from typing_extensions import Self


class PtyPort(serial.Serial):
    """A port of a pseudo-terminal, which has no wires for these signals."""

    def _update_dtr_state(self) -> None:
        pass

    def _update_rts_state(self) -> None:
        pass

    @property
    def cts(self) -> bool:
        return True

    dsr = ri = cd = cts


class Rfc2217Server:
    """A server of one connection after the other, until it is left. Clients open `url`."""

    def __init__(self, port: str) -> None:
        self._serial = PtyPort(port, timeout=0)
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._listener.settimeout(0.05)
        # Where pyserial's client receives nothing, it gives up after 3 s.
        number = self._listener.getsockname()[1]
        self.url = f"rfc2217://127.0.0.1:{number}?timeout={GENEROUS:.0f}"
        self._guest: socket.socket | None = None
        self._left = False
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_error: object) -> None:
        self._left = True
        self._thread.join(GENEROUS)
        self._listener.close()
        self._serial.close()

    def hang_up(self) -> None:
        """Drop the connection, as an adapter does that is switched off."""
        if self._guest is not None:
            self._guest.shutdown(socket.SHUT_RDWR)

    def write(self, data: bytes) -> None:
        """Send the bytes of pyserial's half of the protocol."""
        if self._guest is not None:
            self._guest.sendall(data)

    def _serve(self) -> None:
        while not self._left:
            try:
                self._guest, _ = self._listener.accept()
            except TimeoutError:
                continue
            with self._guest:
                # Both need only look like what the stubs ask for.
                manager = PortManager(self._serial, self)  # type: ignore[arg-type]
                self._carry(self._guest, manager)

    def _carry(self, guest: socket.socket, manager: PortManager) -> None:
        guest.settimeout(0.002)
        while not self._left:
            try:
                data = guest.recv(1024)
                if not data:
                    return
                self._serial.write(b"".join(manager.filter(data)))
            except TimeoutError:
                pass
            except OSError:
                return
            found = self._serial.read(1024)
            try:
                self.write(b"".join(manager.escape(found)))
            except OSError:
                return
