"""The exports of a library, and the imports of their names."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, TypeAlias

from framegen.targets.python.escape import WIDTH

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.model.client_names import ClientNames

_Order: TypeAlias = "tuple[int, tuple[tuple[str, int, str], ...], str]"
# Text, and the number behind it.
_NUMBERED = re.compile(r"(?=.)(\D*)(\d*)")

# What every library exports besides its messages and its client, and the module that each is in.
HOMES = {
    "MESSAGES": ".messages",
    "PROTOCOL_VERSION": "._library",
    "AbsentError": "framewire.line.link_errors",
    "AsyncMotion": "framewire.client.motion",
    "ClosedError": "framewire.line.link_errors",
    "Counters": "framewire.codec.counters",
    "DecodeError": "framewire.frame.errors",
    "Device": ".device",
    "Direction": "._library",
    "DisconnectedError": "framewire.line.link_errors",
    "DoubtfulReplyError": "framewire.line.link_errors",
    "EchoError": "framewire.line.link_errors",
    "EncodeError": "framewire.frame.errors",
    "Event": "._codec",
    "IncompleteReplyError": "framewire.line.link_errors",
    "LimitError": "framewire.frame.errors",
    "LineCounters": "framewire.codec.counters",
    "Message": "framewire.frame.message",
    "Motion": "framewire.client.motion",
    "NoReplyError": "framewire.line.link_errors",
    "NoReportError": "framewire.line.link_errors",
    "NotHeldError": "framewire.line.link_errors",
    "Noise": "framewire.codec.noise",
    "PortAddressError": "framewire.line.link_errors",
    "PortBusyError": "framewire.line.link_errors",
    "PortNotFoundError": "framewire.line.link_errors",
    "PortPermissionError": "framewire.line.link_errors",
    "ProtocolError": "framewire.frame.errors",
    "Reason": "framewire.frame.errors",
    "Run": "framewire.client.request",
    "Sent": "framewire.client.request",
    "StreamDecoder": "._codec",
    "Transport": "framewire.line.transport",
    "TransportError": "framewire.line.link_errors",
    "UnknownFrame": "._codec",
    "WriteStuckError": "framewire.line.link_errors",
    "__version__": "._version",
    "decode": "._codec",
    "open_transport": "._library",
}
# What a library exports beside that whose devices have addresses, or one that nobody answers, and
# one whose devices say what they refuse, or what has failed.
OF_ADDRESSES = {
    "AsyncOneDevice": "._async_devices",
    "OneDevice": "._devices",
}
OF_BROADCASTS = {
    "AllDevices": "._devices",
    "AsyncAllDevices": "._async_devices",
}
OF_FAILURES = {
    "FailureError": "framewire.client.failures",
    "RefusedError": "framewire.client.failures",
}


def homes_of_client(client: ClientNames) -> dict[str, str]:
    """Return the names of a client, and the module that each is in."""
    return {
        client.threads: "._controller",
        client.asyncio: "._async_controller",
        client.opener: "._controller",
        client.async_opener: "._async_controller",
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


def import_from(module: str, names: Iterable[str], indent: int = 0) -> str:
    """Return an import, indented except its first line, an item a line where it is too long."""
    names = sorted(names, key=import_order)
    line = f"from {module} import {', '.join(names)}"
    if indent + len(line) <= WIDTH:
        return line
    margin = " " * indent
    listed = "".join(f"{margin}    {name},\n" for name in names)
    return f"from {module} import (\n{listed}{margin})"
