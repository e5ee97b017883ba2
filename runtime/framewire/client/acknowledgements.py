"""Match commands with the reports that acknowledge them."""

from __future__ import annotations

from collections import deque

from .request import Run

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from ..frame.message import Message
    from .library import Library
    from .request import Request, Sent
    from .wire_time import WireTime

# How many commands may wait for a report at once; the oldest beyond that are no longer followed.
_PENDING = 64


class _Pending:
    """A command that no report has acknowledged yet. `until` is None before the port has it."""

    __slots__ = ("kind", "run", "until")

    def __init__(self, run: Run, kind: type[Message]) -> None:
        self.run = run
        self.kind = kind
        self.until: float | None = None

    def is_met_by(self, report: Message) -> bool:
        command = self.run.message
        shared = [name for name in command.__match_args__ if name in self.kind.__match_args__]
        return type(report) is self.kind and all(
            getattr(report, name) == getattr(command, name) for name in shared
        )


class Acknowledgements:
    """The commands that wait for an acknowledging report, and the reports that have come so far.

    A report may come `reply_timeout` seconds after the time on the wire of both, and later by the
    time that other bytes take that come before it. Only a line that has carried such a report can
    miss one: a device may never send any.
    """

    def __init__(self, library: Library, wire_time: WireTime, reply_timeout: float) -> None:
        self._kinds = library.acknowledging
        self._wire_time = wire_time
        self._reply_timeout = reply_timeout
        self._seen: set[type[Message]] = set()
        self._pending: deque[_Pending] = deque(maxlen=_PENDING)

    def expect(self, request: Request, delay: float, duration: float) -> Run:
        """Return the result of a command that is sent now; its time begins when the port has it."""
        run = Run(request.message, delay, duration)
        run.started = None
        kind = request.exchange.acknowledged
        # A result that a newer command may replace goes to nobody.
        if kind is not None and not request.latest:
            self._pending.append(_Pending(run, kind))
        return run

    @property
    def unwritten(self) -> bool:
        """Whether the port has still to take one of the commands."""
        return any(each.until is None for each in self._pending)

    def written(self, now: float, last: Sent | None = None) -> None:
        """Record that the port has the commands up to `last` (None: all so far) only at `now`."""
        for each in self._pending:
            if each.until is None:
                left_at = max(self._wire_time.free_at, now + each.run.duration)
                size = each.kind.FRAME.size(each.kind.LENGTHS[-1])
                each.until = left_at + self._wire_time.seconds(size) + self._reply_timeout
            if each.run is last:
                return

    def delay(self, size: int) -> None:
        """Extend the deadlines by the time of `size` bytes, which kept the line busy."""
        for each in self._pending:
            if each.until is not None:
                each.until += self._wire_time.seconds(size)

    def add(self, report: Message) -> None:
        """Take in a report. It acknowledges the first command that it matches."""
        if type(report) not in self._kinds:
            return
        self._seen.add(type(report))
        for each in self._pending:
            if each.is_met_by(report):
                each.run.started = True
                self._pending.remove(each)
                return

    def tick(self, now: float) -> None:
        """Advance the time to `now`; all that arrived before must have been added."""
        for each in [each for each in self._pending if each.until is not None]:
            if each.until is not None and now >= each.until:
                self._pending.remove(each)
                if each.kind in self._seen:
                    each.run.started = False

    @property
    def tick_at(self) -> float | None:
        """The latest time at which to call `tick` again."""
        if not self._pending:
            return None
        return min((each.until for each in self._pending if each.until is not None), default=None)

    def restart(self) -> None:
        """Begin anew on another line: what the old one may have carried is never known."""
        self._pending.clear()
        self._seen.clear()
