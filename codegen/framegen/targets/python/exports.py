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
    "AbsentError": "link_errors",
    "AsyncController": "async_controller",
    "AsyncMotion": "motion",
    "ClosedError": "link_errors",
    "Controller": "controller",
    "Counters": "counters",
    "DecodeError": "errors",
    "Device": "device",
    "Direction": "direction",
    "DisconnectedError": "link_errors",
    "EchoError": "link_errors",
    "EncodeError": "errors",
    "IncompleteReplyError": "link_errors",
    "LimitError": "errors",
    "LineCounters": "counters",
    "Message": "message",
    "Motion": "motion",
    "NoReplyError": "link_errors",
    "NoReportError": "link_errors",
    "Noise": "noise",
    "PortAddressError": "link_errors",
    "PortBusyError": "link_errors",
    "PortNotFoundError": "link_errors",
    "PortPermissionError": "link_errors",
    "ProtocolError": "errors",
    "Reason": "errors",
    "Run": "run",
    "Sent": "request",
    "StreamDecoder": "decoder",
    "Transport": "transport",
    "TransportError": "link_errors",
    "UnknownFrame": "noise",
    "WriteStuckError": "link_errors",
    "__version__": "version",
    "decode": "codec",
    "open_async_controller": "async_opening",
    "open_controller": "opening",
    "open_transport": "serial_port",
}


def export_order(name: str) -> _Order:
    """Return the sort key of a name among those that a package exports, as linters want it."""
    return _kind(name), _natural(name), ""


def _import_order(name: str) -> _Order:
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
    names = sorted(names, key=_import_order)
    line = f"from .{module} import {', '.join(names)}"
    if indent + len(line) <= WIDTH:
        return line
    margin = " " * indent
    listed = "".join(f"{margin}    {name},\n" for name in names)
    return f"from .{module} import (\n{listed}{margin})"
