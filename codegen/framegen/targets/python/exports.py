"""What every library exports, from which modules, and how names of a module are imported."""

from __future__ import annotations

from framegen.targets.python.escape import WIDTH

# What every library exports besides its messages, and the module that each is in.
HOMES = {
    "MESSAGES": "messages",
    "AbsentError": "link_errors",
    "AsyncController": "async_controller",
    "AsyncMotion": "motion",
    "ClosedError": "link_errors",
    "Controller": "controller",
    "Counters": "decoder",
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
