"""Whether a line is as slow as its stated rate says, learnt from when its replies come."""

from __future__ import annotations

# So many questions in a row, each answered by one reply sooner than the wire allows, show that the
# line is no such wire: a socket, a pty, a USB link that only calls itself a serial port.
_FAST_AFTER = 3
# So many in a row that took the time they must show that it is one.
_PACED_AFTER = 8


class Pace:
    """What has been learnt of one line.

    `fast`: the stated rate says nothing about it. `paced`: it has kept to that rate so long that a
    reply which came sooner was meant for somebody else. On a line of which neither is known, such a
    reply is believed if no other comes.
    """

    __slots__ = ("_impossible", "_possible", "fast", "paced")

    def __init__(self) -> None:
        self.fast = self.paced = False
        self._possible = self._impossible = 0

    def answered_in_time(self) -> None:
        """A question was answered, no sooner than the wire allows."""
        self._impossible = 0
        self._possible += 1
        self.paced = self.paced or (self._possible >= _PACED_AFTER and not self.fast)

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
