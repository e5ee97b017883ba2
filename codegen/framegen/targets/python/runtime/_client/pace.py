"""An estimate of whether a line is as slow as its stated rate, from the times of its replies."""

from __future__ import annotations

from collections import deque

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .._frame.message import Message

# So many requests in a row, each with one reply sooner than the wire allows, show that the line is
# no such wire: a socket, a pty, a USB link that only calls itself a serial port.
_FAST_AFTER = 3
# So many replies in a row that took at least the time on the wire show that it is one.
_PACED_AFTER = 8


# So many of the latest replies of a kind show the usual delay; fewer than that at first do not.
_USUAL, _ENOUGH = 16, 4


class Pace:
    """The observed pace of one line.

    `fast`: the stated rate means nothing there. `paced`: it has kept to that rate so long that a
    reply which came sooner was meant for somebody else. On a line of which neither is known, such a
    reply is believed if no other comes.
    """

    __slots__ = ("_delays", "_impossible", "_possible", "fast", "paced")

    def __init__(self) -> None:
        self.fast = self.paced = False
        self._possible = self._impossible = 0
        # How many seconds later than the wire allows the latest replies of each kind have come.
        self._delays: dict[type[Message], deque[float]] = {}

    def answered_in_time(self, kind: type[Message], delay: float, step: float) -> float:
        """Record a reply that came `delay` seconds later than the wire allows at the soonest.

        Returns how much later replies of this kind usually come, if this one has come sooner than
        all of the latest by more than `step`: it may be one that was meant for another request, and
        the right one still to come. Otherwise 0.
        """
        self._impossible = 0
        self._possible += 1
        self.paced = self.paced or (self._possible >= _PACED_AFTER and not self.fast)
        latest = self._delays.setdefault(kind, deque(maxlen=_USUAL))
        early = len(latest) >= _ENOUGH and delay < min(latest) - step and not self.fast
        later = max(latest) - delay if early else 0.0
        latest.append(delay)
        return later

    def answered_too_soon(self) -> None:
        """Record a request whose only reply came sooner than the wire allows."""
        self._possible = 0
        self._impossible += 1
        if self._impossible >= _FAST_AFTER:
            self.fast, self.paced = True, False

    def not_answered(self) -> None:
        """Record a request without any reply."""
        self._impossible = 0

    def surplus(self) -> None:
        """Record a reply that answers nothing: earlier delays prove nothing any more."""
        self._impossible = 0
        self.fast = False
