"""How long bytes take on the line, and when it is free again."""

from __future__ import annotations

from .protocol import BITS_PER_BYTE


class Wire:
    """The outgoing half of the line, by calculation: nobody can ask a UART how far it has got."""

    __slots__ = ("free_at", "seconds_per_byte")

    def __init__(self, baud: float) -> None:
        if not baud > 0:
            raise ValueError(f"baud is {baud!r}, and must be above 0 (math.inf for a line at once)")
        self.seconds_per_byte = BITS_PER_BYTE / baud
        # When the last byte that was handed over has left.
        self.free_at = float("-inf")

    def seconds(self, size: int) -> float:
        """How long `size` bytes take."""
        return size * self.seconds_per_byte

    def take(self, size: int, now: float) -> float:
        """Puts `size` bytes on the line behind what is there; gives when their first one leaves."""
        starts = max(now, self.free_at)
        self.free_at = starts + self.seconds(size)
        return starts

    def seen_idle(self, now: float) -> None:
        """Takes note that everything sent has arrived, however long it should have taken."""
        self.free_at = min(self.free_at, now)
