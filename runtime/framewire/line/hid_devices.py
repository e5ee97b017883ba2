"""The USB HID devices that are plugged in: found by the package hidapi, on Linux without it too.

A device of this kind has no serial port. This library has not been tried with such hardware yet.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from .link_errors import TransportError

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path
    from typing import Any

    from .link import Link

UNSEEN = "not seen on hardware yet"
_LINUX = "/sys/bus/hid/devices"


class HidDevice(NamedTuple):
    """A device that is plugged in. `path` is the system's name of it, `product` its own."""

    vendor: int
    product_id: int
    path: str
    product: str

    @property
    def ids(self) -> str:
        """Vendor and product, as `ports` shows them."""
        return f"{self.vendor:04X}:{self.product_id:04X}"


def hid_library(port: str) -> Any:
    """Return the module that speaks USB HID. Raises TransportError if it is not installed."""
    # On Linux one of the two takes the device away from the kernel, and the other does not.
    names = ("hidraw", "hid") if sys.platform.startswith("linux") else ("hid",)
    for name in names:
        try:
            found = import_module(name)
        except (ImportError, OSError):
            continue
        # Another package is imported by the same name, and works otherwise.
        if hasattr(found, "device") and hasattr(found, "enumerate"):
            return found
    happened = f"USB HID needs the package hidapi, which is not installed ({UNSEEN})"
    raise TransportError(port, happened, "pip install hidapi")


def hid_devices(link: Link, library: Any) -> list[HidDevice]:
    """Return the devices of a protocol that are plugged in, as `library` lists them."""
    found = [
        HidDevice(
            each["vendor_id"],
            each["product_id"],
            each["path"].decode(errors="backslashreplace"),
            each.get("product_string") or "",
        )
        for each in library.enumerate()
    ]
    known = (each for each in found if link.report_size(each.vendor, each.product_id) is not None)
    return sorted(known)


def hid_devices_at_hand(link: Link, folder: str | PathLike[str] = _LINUX) -> list[HidDevice] | None:
    """Return the devices that are plugged in without opening any; None if that cannot be known."""
    from pathlib import Path

    try:
        return hid_devices(link, hid_library("hid://"))
    except (TransportError, OSError):
        listed = Path(folder)
        return _as_linux_tells(link, listed) if listed.is_dir() else None


def _as_linux_tells(link: Link, folder: Path) -> list[HidDevice]:
    """Return the devices that Linux lists: a folder each, such as 0003:0483:5750.0001."""
    found: list[HidDevice] = []
    for device in folder.iterdir():
        try:
            bus, vendor, product = device.name.partition(".")[0].split(":")
            ids = int(vendor, 16), int(product, 16)
        except ValueError:
            continue
        if int(bus, 16) == 3 and link.report_size(*ids) is not None:
            names = sorted(each.name for each in (device / "hidraw").glob("hidraw*"))
            path = f"/dev/{names[0]}" if names else ""
            found.append(HidDevice(*ids, path, _name_of(device)))
    return sorted(found)


def _name_of(device: Path) -> str:
    try:
        lines = (device / "uevent").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    named = (line.removeprefix("HID_NAME=") for line in lines if line.startswith("HID_NAME="))
    return next(named, "")
