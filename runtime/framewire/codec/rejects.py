"""Counts of the input that a device rejected, by reason."""

from __future__ import annotations

from ..frame.errors import Reason
from .noise import Noise

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable


class Rejects:
    """Counts of rejected input by reason; consecutive noise counts once.

    `begins` says whether a frame may begin with some bytes.
    """

    __slots__ = ("_begins", "_goes_on", "by_reason", "total")

    def __init__(self, begins: Callable[[bytes], bool]) -> None:
        self._begins = begins
        self.total = 0
        self.by_reason: dict[Reason, int] = {}
        # Whether the last event was noise, so that more of it continues the same.
        self._goes_on = False

    def add(self, noise: Noise) -> bool:
        """Count a piece of noise; return False if it continues the piece before it."""
        rest = self._goes_on and not self._begins(noise.data)
        self._goes_on = True
        if rest:
            return False
        self.total += 1
        self.by_reason[noise.reason] = self.by_reason.get(noise.reason, 0) + 1
        return True

    def end(self) -> None:
        """Record that a message came: noise after it counts anew."""
        self._goes_on = False

    def __repr__(self) -> str:
        reasons = ", ".join(f"{reason.value}: {n}" for reason, n in self.by_reason.items())
        return f"Rejects({self.total}{': ' if reasons else ''}{reasons})"
