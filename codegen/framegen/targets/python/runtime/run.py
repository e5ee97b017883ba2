"""What a command returns that is acknowledged by a report."""

from __future__ import annotations

from .request import Sent


class Run(Sent):
    """A command that has been handed to the line, and whether its receiver has taken it.

    `started` is True once the report has come that acknowledges it, with the same values. It is
    False where none came in the time of a reply, though others have come over this line before: the
    command was ignored. It is None while neither is known; on a line over which no such report has
    ever come, that is for ever.

    It is found out when the line is read: by a client that listens in the background, or while a
    call waits. The report names nobody: another command with the same values has the same.
    """

    __slots__ = ("started",)

    started: bool | None

    def __repr__(self) -> str:
        return f"{super().__repr__()[:-1]}, started={self.started})"
