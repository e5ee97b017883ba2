"""The verb `ports`: what is plugged in."""

from __future__ import annotations

import json
import sys

from serial.tools import list_ports

from .console import visible

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the arguments of the verb."""
    parser.add_argument("--json", action="store_true", help="print each port as a line of JSON")


def run(arguments: Namespace) -> int:
    """Prints a line for each serial port: its name, VID:PID where it has them, what it is."""
    found = sorted(list_ports.comports(), key=lambda each: str(each.device))
    for port in found:
        usb = "" if port.vid is None else f"{port.vid:04X}:{port.pid or 0:04X}"
        about = "" if port.description in (None, "n/a") else str(port.description)
        if arguments.json:
            print(json.dumps({"port": port.device, "usb": usb or None, "description": about}))
        else:
            print(visible(f"{port.device:16}  {usb or '-':9}  {about}".rstrip()))
    if not found:
        print("no serial port is plugged in", file=sys.stderr)
    return 0
