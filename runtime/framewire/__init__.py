"""What libraries of protocols have in common, whatever their protocol.

A library is generated from the specification of its protocol, and knows what that decides. All else
is written here, once. Nothing in here knows a protocol, nor where it lies itself: imports are
relative, so that a copy of the whole folder works below any name.

Errors are named here, as those of all libraries: `except framewire.TransportError`.
"""

# Where errors are; each is imported when it is first needed.
_HOMES = ("frame.errors", "line.link_errors", "client.failures")


def __getattr__(name: str) -> object:
    if name.endswith("Error"):
        for home in _HOMES:
            # Not importlib, which would have to be imported first.
            error = getattr(__import__(f"{__name__}.{home}", fromlist=[name]), name, None)
            if error is not None:
                globals()[name] = error
                return error
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
