"""A serial port as a transport: the only importer of pyserial, whose errors it explains."""

from __future__ import annotations

import errno
import select
import socket
import sys
import time
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from framegen.conformance.device.transport import Transport
    from framegen.language.spec import Link

# How often to look whether bytes have come, in seconds, where nothing tells.
_POLL = 0.001
_WRITE_TIMEOUT = 2.0
_MOST = 4096
_NAMED = "name a port, such as /dev/ttyUSB0 or COM7, or a URL, such as socket://HOST:PORT"
_REACHED = "see that the address is right, and that the other end is there and listening"
_PERMITTED = (
    "add yourself to the group that owns it (dialout on most systems), as by "
    "`sudo usermod -aG dialout $USER`, and log in again"
)
# What pyserial raises besides OSError once its descriptor is gone in mid-call.
_GONE = (OSError, TypeError, ValueError, AttributeError)


def open_port(name: str, link: Link, baud: int) -> Transport:
    """Open a port by its name, or by a URL of pyserial. Raises Unusable."""
    try:
        import serial  # noqa: PLC0415 - only those who open a port need it
    except ModuleNotFoundError:
        raise Unusable(
            "a port needs `pyserial`, which is not installed",
            hint="pip install 'pyserial>=3.5,<4'",
        ) from None
    scheme = name.partition("://")[0].lower() if "://" in name else ""
    _see_to_name(name, scheme)
    try:
        opened = serial.serial_for_url(
            name,
            baudrate=baud,
            bytesize=link.data_bits,
            parity=link.parity[0].upper(),
            stopbits=link.stop_bits,
            timeout=0,
            # pyserial refuses one for RFC 2217.
            write_timeout=None if scheme == "rfc2217" else _WRITE_TIMEOUT,
            exclusive=True,
        )
    except (*_GONE, LookupError, NotImplementedError, StopIteration) as error:
        raise _not_opened(name, error) from None
    # Or else a small write waits for the one before it to be acknowledged.
    behind = getattr(opened, "_socket", None)
    if behind is not None:
        behind.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return SerialPort(opened)


class SerialPort:
    """An open port of pyserial that never blocks by itself. Raises OSError."""

    def __init__(self, port: Any) -> None:
        self._port = port
        self._handle = _handle_of(port)

    def read(self, timeout: float) -> bytes:
        """Return what has arrived, waiting up to `timeout` seconds for the first byte."""
        try:
            return self._read(timeout)
        except _GONE as error:
            raise OSError(f"the line was lost ({error})") from error

    def _read(self, timeout: float) -> bytes:
        if self._handle is not None:
            ready, _, _ = select.select([self._handle], [], [], timeout)
            return bytes(self._port.read(_MOST)) if ready else b""
        until = time.monotonic() + timeout
        while not (data := bytes(self._port.read(_MOST))) and time.monotonic() < until:
            time.sleep(_POLL)
        return data

    def write(self, data: bytes) -> None:
        """Hand over all of `data`."""
        try:
            self._port.write(data)
        except _GONE as error:
            raise OSError(f"it takes no more bytes ({error})") from error

    def close(self) -> None:
        """Close the port."""
        behind = getattr(self._port, "_socket", None)
        self._port.close()
        # Where the other end has hung up, pyserial leaves its socket open.
        if behind is not None:
            behind.close()


def _handle_of(port: Any) -> int | None:
    """Return what `select` can wait for; None where there is none, as on Windows."""
    try:
        handle = port.fileno()
    except (*_GONE, NotImplementedError):
        return None
    return handle if isinstance(handle, int) else None


def _see_to_name(name: str, scheme: str) -> None:
    """Refuse what cannot be the name of a port. Raises Unusable."""
    # spy:// would write to any file that it names.
    if not name.strip() or scheme in ("spy", "hid"):
        raise Unusable(f"{name!r} is no port that can be tested", hint=_NAMED)
    if scheme in ("socket", "rfc2217"):
        try:
            parts = urlsplit(name)
            problem = "" if parts.hostname and parts.port else "it lacks a host or its TCP port"
        except ValueError as error:
            problem = str(error)
        if problem:
            raise Unusable(f"{name} is no address: {problem}", hint=f"write {scheme}://HOST:PORT")


def _not_opened(name: str, error: Exception) -> Unusable:
    """Say why a port could not be opened, and what to do."""
    code, text = getattr(error, "errno", None), str(error)
    low = text.lower()
    # On Windows pyserial gives the system's words instead of an errno.
    denied = code in (errno.EACCES, errno.EPERM) or "permissionerror" in low
    if code in (errno.EBUSY, errno.EAGAIN) or "lock" in low or (denied and sys.platform == "win32"):
        return Unusable(f"{name} is in use", hint="close the other program that has it")
    if denied:
        return Unusable(f"{name}: permission is denied", hint=_PERMITTED)
    if "://" in name:
        why = text.removeprefix(f"Could not open port {name}: ")
        return Unusable(f"{name} cannot be reached: {why}", hint=_REACHED)
    if code in (errno.ENOENT, errno.ENXIO, errno.ENODEV) or "filenotfounderror" in low:
        return Unusable(f"there is no port {name}", hint=_ports_hint())
    return Unusable(f"{name} is no serial port: {text}", hint=_ports_hint())


def _ports_hint() -> str:
    from serial.tools import list_ports  # noqa: PLC0415 - as above

    found = ", ".join(sorted(str(each.device) for each in list_ports.comports()))
    return f"these exist: {found}" if found else "no serial port is plugged in"
