"""The log of this library, in `logging`, which is imported when there is something to log."""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from logging import Logger


def log() -> Logger:
    """Return the logger of this library: it is named after the package."""
    from logging import getLogger

    return getLogger(__package__)


def shows_frames() -> bool:
    """Return whether every frame is logged; never while `logging` is not imported."""
    return "logging" in sys.modules and log().isEnabledFor(sys.modules["logging"].DEBUG)
