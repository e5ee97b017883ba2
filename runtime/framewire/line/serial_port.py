"""A serial port as a transport: pyserial, with errors that say what to do.

Whatever pyserial opens is a port: `/dev/ttyUSB0`, `COM7`, `hwgrep://CH340`, `socket://host:port`,
`rfc2217://host:port`, `loop://`. A name that begins with `hid:` is opened by USB HID instead.
"""

from __future__ import annotations

import math
import select
import socket
import sys
import threading
import time
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from .hid_port import HidPort, open_hid
from .link_errors import (
    ClosedError,
    DisconnectedError,
    TransportError,
    WriteStuckError,
    errno_of,
)
from .port_errors import not_opened
from .port_names import refused_name
from .transport import Transport

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ..codec.protocol_codec import ProtocolCodec
    from .link import Link


# pyserial reconfigures the port whenever its timeout changes, so that stays as it is; longer waits
# are made of several, and shorter ones are waited for here. It is also how long closing waits for a
# read that cannot be cancelled.
_POLL_INTERVAL = 0.05
# How often to look whether bytes have come, where nothing announces them.
_LOOK = 0.001
_WRITE_TIMEOUT = 1.0
_MOST = 4096
# No driver knows a higher bit rate than this.
_FASTER = 2**31
_SOCKET = "socket:"
# What pyserial raises besides OSError if its descriptor is closed during a call.
_GONE = (OSError, TypeError, ValueError, AttributeError)


class SerialPortSeen(NamedTuple):
    """A serial port of this machine. `usb` is VID:PID, empty for a port that is not on USB."""

    name: str
    usb: str
    product: str
    # Kept only so that it can be removed from reports that are sent to others.
    serial: str = ""

    def __str__(self) -> str:
        about = " ".join(filter(None, [self.usb, self.product]))
        return f"{self.name} ({about})" if about else self.name


def serial_ports() -> list[SerialPortSeen]:
    """Return the serial ports that are plugged in."""
    from serial.tools import list_ports

    return sorted(
        SerialPortSeen(
            str(each.device),
            "" if each.vid is None else f"{each.vid:04X}:{each.pid or 0:04X}",
            "" if each.description in (None, "n/a") else str(each.description),
            str(each.serial_number or ""),
        )
        for each in list_ports.comports()
    )


def open_port(
    port: str, link: Link, codec: ProtocolCodec, *, baud: float, exclusive: bool
) -> SerialPort | HidPort:
    """Open a port, as `open_transport` of each library does, which explains it."""
    if isinstance(port, str) and port.lower().startswith("hid:"):
        return open_hid(port, link, codec)
    import serial

    refused = refused_name(port)
    if refused is not None:
        raise refused
    # pyserial knows some of its own schemes in small letters only.
    scheme, separator, rest = port.partition("://")
    url = f"{scheme.lower()}://{rest}" if separator else port
    rate = link.baud if baud == math.inf else baud
    if not 1 <= rate < _FASTER:
        raise ValueError(f"baud is {baud!r}, and must be from 1 to {_FASTER - 1}, or math.inf")
    try:
        opened = serial.serial_for_url(
            url,
            baudrate=int(rate),
            bytesize=link.data_bits,
            parity=link.parity[0].upper(),
            stopbits=link.stop_bits,
            # pyserial reads a socket byte by byte, unless it must not wait: `select` waits for it.
            timeout=0 if url.startswith(_SOCKET) else _POLL_INTERVAL,
            # pyserial refuses a write timeout for RFC 2217, whose socket gives up after 5 s anyway.
            write_timeout=None if url.startswith("rfc2217:") else _WRITE_TIMEOUT,
            exclusive=exclusive or None,
        )
    except (*_GONE, LookupError, NotImplementedError, StopIteration) as error:
        raise not_opened(port, error, _listed, baud=link.baud) from error
    # pyserial lets a socket collect small writes: the second of two would wait for 40 ms.
    behind = getattr(opened, "_socket", None)
    if behind is not None:
        behind.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    reopen = partial(open_port, port, link, codec, baud=baud, exclusive=exclusive)
    return SerialPort(port, opened, reopen)


def _refused_by_terminal() -> type[Exception]:
    """Return what termios raises, which is no OSError, for settings that a terminal does not keep.

    A pseudo terminal keeps no parity, and so refuses to be set a second time, whatever is set; what
    pyserial itself needs to know of it is set all the same.
    """
    error: type[Exception] = getattr(sys.modules.get("termios"), "error", OSError)
    return error


class SerialPort:
    """An open port of pyserial, as a transport. `reopen` opens the same one anew."""

    def __init__(self, name: str, port: Any, reopen: Callable[[], Transport]) -> None:
        self.name = name
        self.reopen = reopen
        self._port = port
        self._handle = _handle_of(port)
        if self._handle is not None:
            # Only then does pyserial return how much was taken. Its own time-out is also raised if
            # all was, but the process had been stopped meanwhile.
            with suppress(_refused_by_terminal()):
                port.write_timeout = 0
        self._at_once = getattr(port, "timeout", None) == 0
        self._closed = False
        # Held until it is closed; acquired again by the thread that closes it, as in a signal
        # handler.
        self._closing = threading.RLock()
        # Held during a read, so that the descriptor is not closed underneath it: its number could
        # be another file's by the time it is used.
        self._reading = threading.Lock()

    def read(self, timeout: float) -> bytes:
        """Return the bytes that have arrived, waiting up to `timeout` seconds for the first one."""
        until = time.monotonic() + timeout
        while True:
            left = until - time.monotonic()
            with self._reading:
                data = self._read_some(min(max(left, 0.0), _POLL_INTERVAL))
            if data or time.monotonic() >= until:
                return data

    def _read_some(self, timeout: float) -> bytes:
        if self._closed:
            raise self._is_closed()
        try:
            if not self._comes(timeout):
                return b""
            if self._at_once:
                return bytes(self._port.read(_MOST))
            arrived = self._port.in_waiting
            data: bytes = self._port.read(min(arrived, _MOST) or 1)
            while data and len(data) < _MOST:
                arrived = self._port.in_waiting
                if not arrived:
                    break
                data += self._port.read(min(arrived, _MOST))
        except _GONE as error:
            raise self._failed(error) from error
        return data

    def _comes(self, timeout: float) -> bool:
        """Return whether bytes come within `timeout`; True also if pyserial's read waits."""
        if self._handle is not None:
            return bool(select.select([self._handle], [], [], timeout)[0])
        if timeout >= _POLL_INTERVAL:
            return True
        until = time.monotonic() + timeout
        while not self._port.in_waiting:
            left = until - time.monotonic()
            if left <= 0:
                return False
            time.sleep(min(left, _LOOK))
        return True

    def write(self, data: bytes) -> None:
        """Write all of `data`."""
        if self._closed:
            raise self._is_closed()
        try:
            taken = self._taken(data)
        except _GONE as error:
            from serial import SerialTimeoutException

            if not isinstance(error, SerialTimeoutException):
                raise self._failed(error) from error
            taken = False
        if not taken:
            raise WriteStuckError(
                self.name,
                f"it has taken no bytes for {_WRITE_TIMEOUT:g} s",
                "unplug and replug the adapter, and see that flow control is off",
            )

    def _taken(self, data: bytes) -> bool:
        """Return whether the port takes all of `data` in time."""
        if self._handle is None:
            self._port.write(data)
            return True
        until = time.monotonic() + _WRITE_TIMEOUT
        while data:
            # Checked once more when time is up: it may have passed while this process stood still.
            left = max(0.0, until - time.monotonic())
            if not select.select([], [self._handle], [], left)[1]:
                return False
            data = data[self._port.write(data) :]
        return True

    def drain(self, timeout: float) -> None:
        """Wait until the last byte has left, as far as the driver can tell."""
        # Not flush(): if a device has stopped taking bytes, tcdrain waits for ever.
        until = time.monotonic() + timeout
        try:
            while getattr(self._port, "out_waiting", 0) and time.monotonic() < until:
                time.sleep(0.002)
        except _GONE as error:
            raise self._failed(error) from error

    def close(self) -> None:
        """Close the port; a read in progress ends first. A second call waits for the first."""
        with self._closing:
            if not self._closed:
                self._closed = True
                self._close()

    def _close(self) -> None:
        cancel = getattr(self._port, "cancel_read", None)
        try:
            if cancel is not None:
                cancel()
        except _GONE:
            pass  # it is being closed anyway
        held = self._reading.acquire(timeout=1.0)
        # pyserial does not close a socket whose other end has gone: it fails one line before.
        behind = getattr(self._port, "_socket", None)
        try:
            self._port.close()
        except _GONE:
            pass  # a port that is gone cannot be closed any better
        finally:
            if behind is not None:
                behind.close()
            if held:
                self._reading.release()

    def _is_closed(self) -> TransportError:
        return ClosedError(self.name, "it has been closed", "open it again")

    def _failed(self, error: Exception) -> TransportError:
        if self._closed:
            return self._is_closed()
        return DisconnectedError(
            self.name,
            f"the line was lost ({error})",
            "check the cable and the power, then reconnect()",
            errno_of(error),
        )


def _handle_of(port: Any) -> int | None:
    """Return the handle that `select` can wait for; None if there is none, as on Windows."""
    try:
        handle = port.fileno()
    except (*_GONE, NotImplementedError):
        return None
    return handle if isinstance(handle, int) else None


def _listed() -> str:
    found = ", ".join(each.name for each in serial_ports())
    return f"these exist: {found}" if found else "no serial port is plugged in"
