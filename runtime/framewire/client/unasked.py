"""Messages that answer questions, and that a device also sends by itself.

Nothing in such a message tells the two apart. It came by itself if all that was asked for has come,
and nobody has asked for so long that no second copy can be on its way.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TypeAlias

    from ..frame.message import Message

    Source: TypeAlias = tuple[type[Message], int | None]


class Unasked:
    """What was asked for on a line, of which device, and has not come yet.

    `latency` is how long a device takes at most until it begins to answer. For twice as long after
    an answer there may be a second copy of it, and after a line was opened an answer to another
    program.
    """

    def __init__(self, latency: float, opened_at: float) -> None:
        self._again = 2 * latency
        self._owed: dict[Source, int] = {}
        # Until when what was asked for may come, or come again.
        self._until: dict[type[Message], float] = {}
        # What has come by itself so far, and so will again.
        self._seen: set[type[Message]] = set()
        self.begin(opened_at)

    def begin(self, opened_at: float) -> None:
        """Record that the line was opened, for the first time or once more."""
        self._settled_at = opened_at + self._again

    def asked(self, kind: type[Message], address: int | None, until: float) -> None:
        """Record that a device was asked for a message, which may come until then."""
        source = kind, address
        self._owed[source] = self._owed.get(source, 0) + 1
        self._extend(kind, until)

    def answered(self, kind: type[Message], address: int | None, now: float) -> bool:
        """Record that a message has come; return whether it was owed."""
        source = kind, address
        owed = self._owed.get(source, 0)
        if owed:
            self._owed[source] = owed - 1
            self._extend(kind, now + self._again)
        return owed > 0

    def came(self, kind: type[Message], address: int | None, now: float) -> bool:
        """Record that a message has come that nobody waits for; return whether by itself."""
        if self.answered(kind, address, now):
            return False
        if now > self._until.get(kind, self._settled_at):
            self._seen.add(kind)
        return kind in self._seen

    def comes(self, kind: type[Message]) -> bool:
        """Return whether a message of this class has come by itself before."""
        return kind in self._seen

    def _extend(self, kind: type[Message], until: float) -> None:
        self._until[kind] = max(until, self._until.get(kind, self._settled_at), self._settled_at)
