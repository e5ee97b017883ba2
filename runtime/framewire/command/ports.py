"""The verb `ports`: what is plugged in, by serial port or by USB HID."""

from __future__ import annotations

import json
import sys

from ..line.hid_devices import UNSEEN, hid_devices_at_hand
from ..line.serial_port import serial_ports
from .console import visible

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from ..line.hid_devices import HidDevice
    from .program import Program

    # The name of a port, VID:PID, and what it is.
    Row = tuple[str, str, str]


def add_arguments(parser: ArgumentParser, _program: Program) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("--json", action="store_true", help="print each port as a line of JSON")


def run(arguments: Namespace, program: Program) -> int:
    """Print a line for each port: its name, VID:PID if it has them, what it is."""
    serial = [(each.name, each.usb, each.product) for each in serial_ports()]
    devices = hid_devices_at_hand(program.library.link)
    for name, usb, about in [*serial, *_by_hid(devices or [])]:
        if arguments.json:
            print(json.dumps({"port": name, "usb": usb or None, "description": about}))
        else:
            print(visible(f"{name:16}  {usb or '-':9}  {about}".rstrip()))
    if not serial:
        print("no serial port is plugged in", file=sys.stderr)
    boards = program.library.link.hid_devices
    if devices is None and boards and not any(usb for _, usb, _ in serial):
        known = ", ".join(f"{vendor:04X}:{product:04X}" for vendor, product, _ in boards)
        hint = f"USB HID devices ({known}) have no serial port, and are not listed without"
        print(f"{hint} hidapi: pip install hidapi", file=sys.stderr)
    return 0


def _by_hid(devices: list[HidDevice]) -> Iterator[Row]:
    """Yield each device without a serial port, by an address that opens it."""
    for each in devices:
        alone = len([other for other in devices if other.ids == each.ids]) == 1
        about = f"{each.product}, USB HID, no serial port ({UNSEEN})".removeprefix(", ")
        yield f"hid://{each.ids if alone else each.path}", each.ids, about
