"""Whether a line is as slow as its stated rate says, learnt from when its replies come."""

from __future__ import annotations

from collections import deque

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .._frame.message import Message

# So many questions in a row, each answered by one reply sooner than the wire allows, show that the
# line is no such wire: a socket, a pty, a USB link that only calls itself a serial port.
_FAST_AFTER = 3
# So many in a row that took the time they must show that it is one.
_PACED_AFTER = 8


# So many of the latest replies of a kind are what is usual; fewer than that at first say nothing.
_USUAL, _ENOUGH = 16, 4


class Pace:
    """What has been learnt of one line.

    `fast`: the stated rate says nothing about it. `paced`: it has kept to that rate so long that a
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
        """A question was answered, `delay` seconds later than the wire allows at the soonest.

        Gives how much later replies of this kind usually come, where this one has come sooner than
        all of the latest by more than `step`: it may be one that was meant for another question,
        and the right one still to come. Else 0.
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
        """A question had one reply alone, and sooner than the wire allows."""
        self._possible = 0
        self._impossible += 1
        if self._impossible >= _FAST_AFTER:
            self.fast, self.paced = True, False

    def not_answered(self) -> None:
        """A question had no reply at all."""
        self._impossible = 0

    def surplus(self) -> None:
        """A reply came that answers nothing: how soon others came tells nothing any more."""
        self._impossible = 0
        self.fast = False
