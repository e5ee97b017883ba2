"""The exports of a library, and the imports of their names."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, TypeAlias

from framegen.targets.python.escape import WIDTH

if TYPE_CHECKING:
    from collections.abc import Iterable

_Order: TypeAlias = "tuple[int, tuple[tuple[str, int, str], ...], str]"
# Text, and the number behind it.
_NUMBERED = re.compile(r"(?=.)(\D*)(\d*)")

# What every library exports besides its messages, and the module that each is in.
HOMES = {
    "MESSAGES": "messages",
    "PROTOCOL_VERSION": "_frame.protocol",
    "AbsentError": "_serial.link_errors",
    "AsyncController": "_client.async_controller",
    "AsyncMotion": "_client.motion",
    "ClosedError": "_serial.link_errors",
    "Controller": "_client.controller",
    "Counters": "_codec.counters",
    "DecodeError": "_frame.errors",
    "Device": "device",
    "Direction": "_frame.directions",
    "DisconnectedError": "_serial.link_errors",
    "DoubtfulReplyError": "_serial.link_errors",
    "EchoError": "_serial.link_errors",
    "EncodeError": "_frame.errors",
    "Event": "_codec.codec",
    "IncompleteReplyError": "_serial.link_errors",
    "LimitError": "_frame.errors",
    "LineCounters": "_codec.counters",
    "Message": "_frame.message",
    "Motion": "_client.motion",
    "NoReplyError": "_serial.link_errors",
    "NoReportError": "_serial.link_errors",
    "NotHeldError": "_serial.link_errors",
    "Noise": "_codec.noise",
    "PortAddressError": "_serial.link_errors",
    "PortBusyError": "_serial.link_errors",
    "PortNotFoundError": "_serial.link_errors",
    "PortPermissionError": "_serial.link_errors",
    "ProtocolError": "_frame.errors",
    "Reason": "_frame.errors",
    "Run": "_client.request",
    "Sent": "_client.request",
    "StreamDecoder": "_codec.codec",
    "Transport": "_serial.transport",
    "TransportError": "_serial.link_errors",
    "UnknownFrame": "_codec.codec",
    "WriteStuckError": "_serial.link_errors",
    "__version__": "_version",
    "decode": "_codec.codec",
    "open_async_controller": "_client.async_opening",
    "open_controller": "_client.opening",
    "open_transport": "_serial.opening",
}
# What a library exports beside that whose devices have addresses, or one that nobody answers, and
# one whose devices say what they refuse, or what has failed.
OF_ADDRESSES = {
    "AsyncOneDevice": "_client.async_devices",
    "OneDevice": "_client.devices",
}
OF_BROADCASTS = {
    "AllDevices": "_client.devices",
    "AsyncAllDevices": "_client.async_devices",
}
OF_FAILURES = {
    "FailureError": "_client.failures",
    "RefusedError": "_client.failures",
}


def export_order(name: str) -> _Order:
    """Return the sort key of a name among those that a package exports, as linters want it."""
    return _kind(name), _natural(name), ""


def import_order(name: str) -> _Order:
    """Return the sort key of a name among those that are imported from a module."""
    return _kind(name), _natural(name.lower()), name


def _kind(name: str) -> int:
    """Return the rank of a name: constants before classes, and classes before all else."""
    return 0 if name.isupper() and len(name) > 1 else 1 if name[0].isupper() else 2


def _natural(name: str) -> tuple[tuple[str, int, str], ...]:
    """Return a sort key by which X9 precedes X10: numbers by size, unless they begin with 0."""
    return tuple(
        (text, 0 if number.startswith("0") else len(number), number)
        for text, number in _NUMBERED.findall(name)
    )


def relative_import(module: str, names: Iterable[str], indent: int = 0) -> str:
    """Return an import, indented except its first line, an item a line where it is too long."""
    names = sorted(names, key=import_order)
    line = f"from .{module} import {', '.join(names)}"
    if indent + len(line) <= WIDTH:
        return line
    margin = " " * indent
    listed = "".join(f"{margin}    {name},\n" for name in names)
    return f"from .{module} import (\n{listed}{margin})"
