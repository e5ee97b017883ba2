"""What a device refused: how often, and why."""

from __future__ import annotations

from .._frame.errors import Reason
from .._frame.protocol import HEADER
from .noise import Noise


class Rejects:
    """Counts what was no message, by reason. Noise that goes on is counted once."""

    __slots__ = ("_goes_on", "by_reason", "total")

    def __init__(self) -> None:
        self.total = 0
        self.by_reason: dict[Reason, int] = {}
        # Whether the last thing heard was noise, so that more of it is the rest of the same.
        self._goes_on = False

    def add(self, noise: Noise) -> bool:
        """Counts a piece of noise; False where it is the rest of the piece before it."""
        rest = self._goes_on and not noise.data.startswith(HEADER)
        self._goes_on = True
        if rest:
            return False
        self.total += 1
        self.by_reason[noise.reason] = self.by_reason.get(noise.reason, 0) + 1
        return True

    def end(self) -> None:
        """Says that a message was heard: noise after it is counted anew."""
        self._goes_on = False

    def __repr__(self) -> str:
        reasons = ", ".join(f"{reason.value}: {n}" for reason, n in self.by_reason.items())
        return f"Rejects({self.total}{': ' if reasons else ''}{reasons})"
