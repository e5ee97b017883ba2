"""What every library exports, from which modules, and how names of a module are imported."""

from __future__ import annotations

from framegen.targets.python.escape import WIDTH

# What else every library exports, and the module that each is in: imported when it is asked for,
# because a user of the codec needs no port.
LAZY = {
    "AsyncController": "async_controller",
    "ClosedError": "link_errors",
    "Controller": "controller",
    "Device": "device",
    "DisconnectedError": "link_errors",
    "IncompleteReplyError": "link_errors",
    "NoReplyError": "link_errors",
    "NoReportError": "link_errors",
    "PortAddressError": "link_errors",
    "PortBusyError": "link_errors",
    "PortNotFoundError": "link_errors",
    "PortPermissionError": "link_errors",
    "Sent": "request",
    "Transport": "transport",
    "TransportError": "link_errors",
    "WriteStuckError": "link_errors",
    "open_async_controller": "async_opening",
    "open_controller": "opening",
    "open_transport": "serial_port",
}

# What every library exports besides its messages.
EXPORTED = (
    "MESSAGES",
    "Counters",
    "DecodeError",
    "Direction",
    "EncodeError",
    "Message",
    "Noise",
    "ProtocolError",
    "Reason",
    "StreamDecoder",
    "UnknownFrame",
    "__version__",
    "decode",
)


def export_order(name: str) -> tuple[int, str]:
    """The place of a name among those that a package exports, as linters want them."""
    kind = 0 if name.isupper() else 1 if name[0].isupper() else 2
    return kind, name


def relative_import(module: str, names: list[str], indent: int = 0) -> str:
    """An import, indented but for its first line, an item a line where it needs to."""
    line = f"from .{module} import {', '.join(names)}"
    if indent + len(line) <= WIDTH:
        return line
    margin = " " * indent
    listed = "".join(f"{margin}    {name},\n" for name in names)
    return f"from .{module} import (\n{listed}{margin})"
