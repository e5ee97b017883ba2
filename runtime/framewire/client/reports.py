"""The reports that have come: kept for whoever takes them, up to a limit."""

from __future__ import annotations

from collections import deque

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from ..frame.message import Message
    from .report_filter import ReportFilter

# How many commands are remembered as possible causes of reports.
_CAUSES = 64


class _Entry:
    __slots__ = ("awaited", "message", "number")

    def __init__(self, number: int, message: Message) -> None:
        self.number = number
        self.message = message
        self.awaited = False


class ReportLog:
    """The latest `limit` reports, each numbered from 0 on.

    If more come, the oldest go; those that nobody had taken are counted in `lost`.
    """

    def __init__(self, limit: int) -> None:
        if limit < 1:
            raise ValueError(f"the limit of reports is {limit!r}, and must be at least 1")
        self._kept: deque[_Entry] = deque(maxlen=limit)
        self._causes: deque[tuple[int, Message, tuple[type[Message], ...]]] = deque(maxlen=_CAUSES)
        self._taken = 0
        self.next_number = 0
        self.lost = 0

    def add(self, message: Message) -> None:
        """Take in a report."""
        self._kept.append(_Entry(self.next_number, message))
        self.next_number += 1
        oldest = self._kept[0].number
        if self._taken < oldest:
            self.lost += oldest - self._taken
            self._taken = oldest

    def caused(self, command: Message, reports: tuple[type[Message], ...]) -> None:
        """Record that a command has been sent which such reports may follow."""
        self._causes.append((self.next_number, command, reports))

    def take(self) -> Message | None:
        """Return the oldest report that has not been taken yet, and mark it as taken."""
        if self._taken >= self.next_number:
            return None
        entry = self._kept[self._taken - self._kept[0].number]
        self._taken += 1
        return entry.message

    def since(self, wanted: ReportFilter) -> int:
        """Return the number of the first report that may result from the latest matching command.

        A command with the wanted values, such as a number, goes before one with none of them: the
        former begins what the latter may end.
        """
        latest: int | None = None
        for number, command, reports in reversed(self._causes):
            if not wanted.may_follow(command, reports):
                continue
            if wanted.requested_of(type(command)):
                return number
            latest = number if latest is None else latest
        return self.next_number if latest is None else latest

    def find(self, wanted: ReportFilter, *, since: int, began_at: int) -> Message | None:
        """Return the first matching report, from number `since` on.

        One that came before number `began_at` satisfies only one wait: the next needs another.
        """
        for entry in self._kept:
            if entry.number < since or (entry.awaited and entry.number < began_at):
                continue
            if wanted.is_met_by(entry.message):
                entry.awaited = True
                return entry.message
        return None

    def instead_of(self, wanted: ReportFilter, *, since: int) -> dict[Message, int]:
        """Return how often each of the other reports came, from number `since` on."""
        counts: dict[Message, int] = {}
        for entry in self._kept:
            if entry.number >= since and not wanted.is_met_by(entry.message):
                counts[entry.message] = counts.get(entry.message, 0) + 1
        return counts
