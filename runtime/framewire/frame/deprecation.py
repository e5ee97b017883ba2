"""Warns whoever still makes what the specification deprecates."""

from __future__ import annotations

import sys
from warnings import warn

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from types import FrameType

    from .message import Message

_RUNTIME = __name__.partition(".")[0]


def warn_deprecated(kind: type[Message]) -> None:
    """Warn of a deprecated message at the line, outside of its library, that makes it."""
    inside = {_RUNTIME, kind.__module__.partition(".")[0]}
    frame: FrameType | None = sys._getframe(1)
    level = 2
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] in inside:
        frame, level = frame.f_back, level + 1
    what = f"{kind.__name__} is deprecated: {kind.DEPRECATED}"
    warn(what, DeprecationWarning, stacklevel=level)
