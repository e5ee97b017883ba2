"""The wait on a line that has just been opened: replies to an earlier program may still come."""

from __future__ import annotations

_NEVER = float("-inf")


class Settling:
    """The time until which no question is sent on a line that has just been opened.

    `seconds` after it was opened; or, for None, one reply time of the first question, unless that
    comes behind a command and no bytes have come.
    """

    def __init__(self, seconds: float | None, opened_at: float) -> None:
        if seconds is not None and not seconds >= 0:
            raise ValueError(f"settle is {seconds!r}, and must be 0 seconds or more, or None")
        self._seconds = seconds
        self.begin(opened_at)

    def begin(self, opened_at: float) -> None:
        """Record that the line was opened, for the first time or once more."""
        self._opened_at = opened_at
        self._question_first: bool | None = None
        self._received = self._over = False

    def submitted(self, *, question: bool) -> None:
        """Record what there is to be sent."""
        if self._question_first is None:
            self._question_first = question

    def received(self) -> None:
        """Record that something has come."""
        self._received = True

    def question_sent(self) -> None:
        """Record that a question has been sent: nothing settles behind it."""
        self._over = True

    def until(self, reply_time: float) -> float:
        """Return until when a question must wait whose reply takes at most so long."""
        if self._over or not (self._question_first or self._received):
            return _NEVER
        return self._opened_at + (reply_time if self._seconds is None else self._seconds)
