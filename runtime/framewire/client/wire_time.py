"""Times on the wire: how long bytes take, when the line is free, what is impossible."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..line.link import Link

# A UART may run this much faster than its stated rate and still be understood; a reply is called
# impossible only if even such a line could not have carried it.
_FASTEST = 0.95


class WireTime:
    """The outgoing half of the line, by calculation: a UART does not report how far it has got."""

    __slots__ = ("free_at", "free_soonest", "seconds_per_byte")

    def __init__(self, link: Link, baud: float) -> None:
        if not baud > 0:
            raise ValueError(f"baud is {baud!r}, and must be above 0 (math.inf for a line at once)")
        self.seconds_per_byte = link.bits_per_byte / baud
        # When the last byte handed over has left; and when it can have left at the soonest.
        self.free_at = self.free_soonest = float("-inf")

    def seconds(self, size: int) -> float:
        """Return how long `size` bytes take."""
        return size * self.seconds_per_byte

    def least(self, size: int) -> float:
        """Return how long `size` bytes take at the least, on a line that runs a little fast."""
        return size * self.seconds_per_byte * _FASTEST

    def take(self, size: int, now: float) -> float:
        """Put `size` bytes on the line behind the others; return when the first of them leaves."""
        starts = max(now, self.free_at)
        self.free_at = starts + self.seconds(size)
        self.free_soonest = max(now, self.free_soonest) + self.least(size)
        return starts

    def seen_idle(self, now: float) -> None:
        """Record that everything sent has arrived, however long it should have taken."""
        self.free_at = min(self.free_at, now)
        self.free_soonest = min(self.free_soonest, now)

    def clear(self) -> None:
        """Record that this is another line, on which no bytes are on their way."""
        self.free_at = self.free_soonest = float("-inf")
