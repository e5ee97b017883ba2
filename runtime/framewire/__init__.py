"""What libraries of protocols have in common, whatever their protocol.

A library is generated from the specification of its protocol, and knows what that decides. All else
is written here, once. Nothing in here knows a protocol, nor where it lies itself: imports are
relative, so that the whole folder works below any name, such as `_runtime` in a library that
carries it.

Errors are named here, as those of all libraries: `except framewire.TransportError`.
"""

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .client.failures import FailureError, RefusedError
    from .frame.errors import DecodeError, EncodeError, LimitError, ProtocolError
    from .line.link_errors import (
        AbsentError,
        ClosedError,
        DisconnectedError,
        DoubtfulReplyError,
        EchoError,
        IncompleteReplyError,
        NoReplyError,
        NoReportError,
        NotHeldError,
        PortAddressError,
        PortBusyError,
        PortNotFoundError,
        PortPermissionError,
        TransportError,
        WriteStuckError,
    )

__all__ = [
    "AbsentError",
    "ClosedError",
    "DecodeError",
    "DisconnectedError",
    "DoubtfulReplyError",
    "EchoError",
    "EncodeError",
    "FailureError",
    "IncompleteReplyError",
    "LimitError",
    "NoReplyError",
    "NoReportError",
    "NotHeldError",
    "PortAddressError",
    "PortBusyError",
    "PortNotFoundError",
    "PortPermissionError",
    "ProtocolError",
    "RefusedError",
    "TransportError",
    "WriteStuckError",
]

# Where errors are; each is imported when it is first needed.
_HOMES = ("frame.errors", "line.link_errors", "client.failures")

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        if name in __all__:
            for home in _HOMES:
                # Not importlib, which would have to be imported first.
                error = getattr(__import__(f"{__name__}.{home}", fromlist=[name]), name, None)
                if error is not None:
                    globals()[name] = error
                    return error
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
