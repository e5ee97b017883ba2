"""A USB HID device as a transport: reports that carry the same frames. Not tried on hardware yet.

A frame is sent at the start of a report, behind the report's number, which is 0, and padded with
zeros; frames of the device come the same way. This follows published descriptions of such devices.
"""

from __future__ import annotations

import math
import os
import re
import threading
import time
from functools import partial
from typing import TYPE_CHECKING

from ..frame.bytes_like import format_hex
from ..frame.errors import Reason
from .hid_devices import UNSEEN, hid_devices, hid_library
from .link_errors import (
    ClosedError,
    DisconnectedError,
    PortAddressError,
    PortNotFoundError,
    PortPermissionError,
    TransportError,
)
from .log import Log

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from ..codec.protocol_codec import ProtocolCodec
    from .hid_devices import HidDevice
    from .link import Link

SCHEME = "hid:"
_IDS = re.compile(r"([0-9a-fA-F]{4}):([0-9a-fA-F]{4})")
_NAMED = "write hid:// for the one device that is plugged in, hid://VENDOR:PRODUCT or hid://PATH"
_USUAL_SIZE = 64
# A read cannot be interrupted: longer waits are made of several.
_POLL_INTERVAL = 0.05


def open_hid(port: str, link: Link, codec: ProtocolCodec, *, library: Any = None) -> HidPort:
    """Open a device by USB HID: `hid://`, `hid://0483:5750`, or `hid://` and the system's path.

    Raises TransportError. `library` is the module that speaks USB HID; None imports it.
    """
    scheme, separator, rest = port.partition("://")
    if not separator or f"{scheme.lower()}:" != SCHEME:
        raise PortAddressError(port, "it is no address of USB HID", _NAMED)
    hid = hid_library(port) if library is None else library
    seen = _chosen(port, rest, link, hid_devices(link, hid))
    device = hid.device()
    try:
        device.open_path(seen.path.encode())
        # Otherwise a read without a timeout would wait for ever.
        device.set_nonblocking(1)
    except (OSError, ValueError) as error:
        raise _not_opened(port, seen, codec.package, error) from error
    size = link.report_size(seen.vendor, seen.product_id) or _USUAL_SIZE
    reopen = partial(open_hid, port, link, codec, library=library)
    return HidPort(port, device, size, reopen, codec)


def _chosen(port: str, wanted: str, link: Link, found: list[HidDevice]) -> HidDevice:
    """Return the one device that the port name selects."""
    ids = _IDS.fullmatch(wanted)
    if ids is not None:
        pair = int(ids[1], 16), int(ids[2], 16)
        fitting = [each for each in found if (each.vendor, each.product_id) == pair]
    else:
        fitting = [each for each in found if wanted in ("", each.path)]
    if len(fitting) == 1:
        return fitting[0]
    listed = ", ".join(f"hid://{each.path} ({each.ids})" for each in found)
    if fitting:
        raise PortAddressError(port, f"{len(fitting)} devices are plugged in", f"choose: {listed}")
    if found:
        raise PortNotFoundError(port, "there is no such device", f"these exist: {listed}")
    known = ", ".join(f"{vendor:04X}:{product:04X}" for vendor, product, _ in link.hid_devices)
    happened = f"no USB HID device is plugged in ({known or 'none is known'})"
    raise PortNotFoundError(port, happened, "`ports` lists those that have a serial port")


def _not_opened(port: str, seen: HidDevice, package: str, error: Exception) -> TransportError:
    """Return the error for a device that is there but cannot be opened: hidapi gives no reason."""
    rule = (
        'KERNEL=="hidraw*", '
        f'ATTRS{{idVendor}}=="{seen.vendor:04x}", ATTRS{{idProduct}}=="{seen.product_id:04x}", '
        'TAG+="uaccess"'
    )
    remedy = f"as root, put this line into /etc/udev/rules.d/70-{package}.rules: {rule} ; replug"
    if seen.path.startswith("/dev/") and not os.access(seen.path, os.R_OK | os.W_OK):
        return PortPermissionError(port, f"permission is denied to {seen.path}", remedy)
    advice = f"close the other program that has it; on Linux it may be the permission: {remedy}"
    return TransportError(port, f"{seen.ids} cannot be opened ({error}; {UNSEEN})", advice)


class HidPort:
    """An open USB HID device, as a transport. `reopen` opens the same one anew.

    `device` has the methods of a device of hidapi, and `codec` tells where a frame ends. No frame
    of more than `largest_frame` bytes can be sent. In a report that begins with a frame, all that
    follows the frame is padding, and dropped; in any other, only zeros at its end are.
    """

    def __init__(
        self,
        name: str,
        device: Any,
        largest_frame: int,
        reopen: Callable[[], HidPort],
        codec: ProtocolCodec,
    ) -> None:
        self.name = name
        self.reopen = reopen
        self.largest_frame = largest_frame
        self._device = device
        self._codec = codec
        self._log = Log(codec.package)
        self._closed = False
        # How many bytes of a frame that is longer than a report are still to come.
        self._rest = 0
        # Held until it is closed; acquired again by the thread that closes it, as in a signal
        # handler.
        self._closing = threading.RLock()
        # Held during a read, so that the device is not closed underneath it.
        self._reading = threading.Lock()

    def read(self, timeout: float) -> bytes:
        """Return the bytes that have arrived, waiting up to `timeout` seconds for the first one."""
        until = time.monotonic() + timeout
        while True:
            left = until - time.monotonic()
            with self._reading:
                report = self._read_report(min(max(left, 0.0), _POLL_INTERVAL))
            data = self._unpadded(report)
            if data or time.monotonic() >= until:
                return data

    def _read_report(self, timeout: float) -> bytes:
        if self._closed:
            raise self._is_closed()
        wait = math.ceil(timeout * 1000)
        try:
            # With 0, hidapi does not look at the time at all.
            given = (wait,) if wait else ()
            return bytes(self._device.read(self.largest_frame, *given))
        except (OSError, ValueError) as error:
            raise self._failed(str(error)) from error

    def _unpadded(self, report: bytes) -> bytes:
        """Return a report without its padding."""
        end, self._rest = self._rest, 0
        if not end:
            verdict = self._codec.table_for(self._codec.received).weigh(report)
            begun = verdict.kind is not None or verdict.reason is Reason.TOO_SHORT
            end = verdict.size if begun else self._codec.heads.claimed(report)
            if end > len(report) and not begun:
                end = 0
        if not end:
            return report.rstrip(b"\x00")
        self._rest = max(0, end - len(report))
        dropped = report[end:].rstrip(b"\x00")
        if dropped:
            self._log().debug(
                "%s: padding that is not 0 was dropped | %s", self.name, format_hex(dropped)
            )
        return report[:end]

    def write(self, data: bytes) -> None:
        """Write a frame, in a report. Raises TransportError if it does not fit into one."""
        if self._closed:
            raise self._is_closed()
        if len(data) > self.largest_frame:
            happened = f"{len(data)} bytes do not fit into a report, which has {self.largest_frame}"
            raise TransportError(self.name, happened, "send them in shorter frames")
        # The missing rest of an earlier frame belongs to a request that is over.
        self._rest = 0
        try:
            written = self._device.write(b"\x00" + data.ljust(self.largest_frame, b"\x00"))
        except (OSError, ValueError) as error:
            raise self._failed(str(error)) from error
        if written < 0:
            raise self._failed("the report was not taken")

    def drain(self, timeout: float) -> None:
        """Return at once: a report that was written has arrived."""

    def close(self) -> None:
        """Close the device; a read in progress ends first. A second call waits for the first."""
        with self._closing:
            if not self._closed:
                self._closed = True
                self._close()

    def _close(self) -> None:
        held = self._reading.acquire(timeout=1.0)
        try:
            self._device.close()
        except (OSError, ValueError):
            pass  # what is gone cannot be closed any better
        finally:
            if held:
                self._reading.release()

    def _is_closed(self) -> TransportError:
        return ClosedError(self.name, "it has been closed", "open it again")

    def _failed(self, why: str) -> TransportError:
        if self._closed:
            return self._is_closed()
        advice = "check the cable and the power, then reconnect()"
        return DisconnectedError(self.name, f"the device was lost ({why})", advice)
