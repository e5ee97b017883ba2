"""A line and a board in one, in virtual time, for threads and for asyncio; and a loop on it."""

from collections.abc import Callable, Coroutine, Iterable
from functools import wraps
from typing import Any, TypeVar

from busservo import AsyncController, ClosedError, DisconnectedError, Message
from busservo_simulator import VirtualClock
from framewire.simulator.virtual_loop import run_virtual

from tests.lines.receiving import Receiving, unanswered
from tests.lines.timed_line import TimedLine

# What comes for a message: at once, or each so many seconds later.
Answer = Callable[[Message], Iterable[Message | tuple[float, bytes | Message]]]

_Result = TypeVar("_Result")


class VirtualLine(Receiving, TimedLine):
    """A transport whose other end answers messages; `error` is what its reads and writes raise."""

    name = "virtual line"

    def __init__(
        self,
        answer: Answer = unanswered,
        timer: VirtualClock | None = None,
        *,
        in_order: bool = True,
        **before: Callable[[], object],
    ) -> None:
        Receiving.__init__(self, **before)
        TimedLine.__init__(self, timer=timer, in_order=in_order)
        self.answer = answer
        # How many messages had been received when it was drained.
        self.drained = 0
        self.error: Exception | None = None

    def unplug(self) -> None:
        self.error = DisconnectedError(self.name, "the line was lost", "plug it in again")
        if self._readable is not None:
            self._readable()

    def read(self, timeout: float) -> bytes:
        self._begin("read")
        self._check()
        return super().read(timeout)

    def write(self, data: bytes) -> None:
        self._check()
        for message in self.heard(data):
            for each in self.answer(message):
                delay, answer = each if isinstance(each, tuple) else (0.0, each)
                self.say(answer, delay)

    def drain(self, _timeout: float) -> None:
        self.drained = len(self.received)

    def reopen(self) -> "VirtualLine":
        return VirtualLine(self.answer, self.timer)

    def _check(self) -> None:
        if self.closed:
            raise ClosedError(self.name, "it has been closed", "open it again")
        if self.error is not None:
            raise self.error


def client(line: VirtualLine, **settings: Any) -> AsyncController:
    """Return a client for asyncio on the time of its line."""
    return AsyncController(line, background=False, clock=line.clock, **settings)


def run(work: Coroutine[Any, Any, _Result], line: TimedLine | None = None) -> _Result:
    """Run a coroutine on the time of a line, or of those that it makes itself."""
    return run_virtual(work, VirtualClock() if line is None else line.timer)


def in_virtual_time(test: Callable[..., Coroutine[Any, Any, None]]) -> Callable[..., None]:
    """Run a test that is a coroutine in virtual time; lines that are made there are on it."""

    @wraps(test)
    def ran(**fixtures: Any) -> None:
        run(test(**fixtures))

    return ran
