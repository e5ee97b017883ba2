"""The log of a library, in `logging`, which is imported when there is something to log."""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from logging import Logger


class Log:
    """The log of one library."""

    __slots__ = ("_package",)

    def __init__(self, package: str) -> None:
        self._package = package

    def __call__(self) -> Logger:
        """Return the logger of the library: it is named after the package."""
        from logging import getLogger

        return getLogger(self._package)

    def shows_frames(self) -> bool:
        """Return whether every frame is logged; never while `logging` is not imported."""
        return "logging" in sys.modules and self().isEnabledFor(sys.modules["logging"].DEBUG)
