"""An estimate of whether a line is as slow as its stated rate, from the times of its replies."""

from __future__ import annotations

from collections import deque

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..frame.message import Message

# So many requests in a row, each with one reply sooner than the wire allows, show that the line is
# no such wire: a socket, a pty, a USB link that only calls itself a serial port.
_FAST_AFTER = 3
# So many replies in a row that took at least the time on the wire show that it is one.
_PACED_AFTER = 8


# So many of the latest replies of a kind show the usual delay; fewer than that at first do not.
_USUAL, _ENOUGH = 16, 4


class Pace:
    """The observed pace of one line, and of each device on it, by address; None for the only one.

    `fast`: the stated rate means nothing there. `paced`: it has kept to that rate so long that a
    reply which came sooner was meant for somebody else. On a line of which neither is known, such a
    reply is believed if no other comes.
    """

    __slots__ = ("_delays", "_doubtful", "_fast", "_impossible", "_possible", "paced")

    def __init__(self) -> None:
        self._fast = self.paced = False
        self._possible = 0
        # How many replies in a row came sooner than the wire allows, by the device.
        self._impossible: dict[int | None, int] = {}
        # The devices that have sent what answers nothing: of them it is to be seen again.
        self._doubtful: set[int | None] = set()
        # How many seconds later than the wire allows the latest replies have come, of each kind.
        self._delays: dict[tuple[type[Message], int | None], deque[float]] = {}

    @property
    def fast(self) -> bool:
        """Whether the stated rate means nothing on this line, whoever answers."""
        return self._fast and not self._doubtful

    def is_fast(self, address: int | None) -> bool:
        """Return whether the stated rate means nothing for the replies of a device."""
        return self._fast and address not in self._doubtful

    @property
    def keeps_time(self) -> bool:
        """Whether the times of replies tell anything: the latest answers took their time."""
        return self.paced or self._possible > 0

    @property
    def slowest(self) -> float | None:
        """How much later than the wire allows replies come at most; None while that is unknown."""
        if self._fast:
            return 0.0
        return max((max(latest) for latest in self._delays.values()), default=None)

    def answered_in_time(
        self, kind: type[Message], address: int | None, delay: float, step: float
    ) -> float:
        """Record a reply that came `delay` seconds later than the wire allows at the soonest.

        Returns how much later replies of this kind usually come, if this one has come sooner than
        all of the latest by more than `step`: it may be one that was meant for another request, and
        the right one still to come. Otherwise 0.
        """
        fast = self.is_fast(address)
        self._impossible.clear()
        self._possible += 1
        self.paced = self.paced or (self._possible >= _PACED_AFTER and not fast)
        latest = self._delays.setdefault((kind, address), deque(maxlen=_USUAL))
        early = len(latest) >= _ENOUGH and delay < min(latest) - step and not fast
        later = max(latest) - delay if early else 0.0
        latest.append(delay)
        return later

    def is_unusual(
        self, kind: type[Message], address: int | None, delay: float, step: float
    ) -> bool:
        """Return whether a reply came later than all of the latest by more than `step`."""
        latest = self._delays.get((kind, address), ())
        return len(latest) >= _ENOUGH and delay > max(latest) + step

    def answered_too_soon(self, address: int | None) -> None:
        """Record a request whose only reply came sooner than the wire allows."""
        self._possible = 0
        self._impossible[address] = self._impossible.get(address, 0) + 1
        if self._impossible[address] >= _FAST_AFTER:
            self._doubtful.discard(address)
        if sum(self._impossible.values()) >= _FAST_AFTER:
            self._fast, self.paced = True, False

    def not_answered(self, address: int | None) -> None:
        """Record a request without any reply."""
        self._impossible.pop(address, None)

    def surplus(self, address: int | None) -> None:
        """Record a reply that answers nothing: earlier delays prove nothing any more."""
        self._impossible.pop(address, None)
        self._doubtful.add(address)
