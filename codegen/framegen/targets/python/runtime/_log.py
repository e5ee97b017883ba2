"""The log of this library, in `logging`, which is imported when there is something to say."""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from logging import Logger


def log() -> Logger:
    """What the library logs to: it is named after the package."""
    from logging import getLogger

    return getLogger(__package__)


def shows_frames() -> bool:
    """Whether every frame is to be logged: nobody has asked who has not imported `logging`."""
    return "logging" in sys.modules and log().isEnabledFor(sys.modules["logging"].DEBUG)
