"""A board at the end of a line for asyncio, in virtual time: no thread, and nothing sleeps."""

from __future__ import annotations

import asyncio
from bisect import insort
from typing import TYPE_CHECKING, TypeVar

from busservo import (
    AsyncController,
    ClosedError,
    Direction,
    DisconnectedError,
    Message,
    Noise,
    StreamDecoder,
)
from busservo._codec.rejects import Rejects
from busservo_simulator import VirtualClock
from busservo_simulator.virtual_loop import VirtualLoop, run_virtual

from tests.lines.live_line import answered

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine
    from typing import Any

_Result = TypeVar("_Result")


class LoopLine:
    """A transport whose other end answers at once, or reports after a delay."""

    name = "loop line"

    def __init__(
        self,
        answer: Callable[[Message], list[Message]] = answered,
        clock: VirtualClock | None = None,
    ) -> None:
        self.clock = clock or clock_of_the_loop()
        self.received: list[Message] = []
        self.lost = False
        self.closed = False
        self.drained = 0
        # No client may ever make this count: see tests/conftest.py.
        self.rejects = Rejects()
        self._answer = answer
        self._decoder = StreamDecoder(Direction.HOST_TO_CONTROLLER)
        self._arriving: list[tuple[float, bytes]] = []
        self._arrived = b""
        self._readable: Callable[[], object] = int
        self.clock.when_due(lambda: self._arriving[0][0] if self._arriving else None)
        self.clock.when_moved(self._move)

    def say(self, message: Message, delay: float = 0.0) -> None:
        """Let a report arrive, `delay` seconds from now."""
        insort(self._arriving, (self.clock.now() + delay, message.encode()))
        self._move()

    def unplug(self) -> None:
        self.lost = True
        self._readable()

    def on_readable(self, callback: Callable[[], object]) -> None:
        self._readable = callback

    def read(self, timeout: float) -> bytes:
        assert timeout == 0, "the loop waits, and nobody else"
        self._check()
        data, self._arrived = self._arrived, b""
        return data

    def write(self, data: bytes) -> None:
        self._check()
        for event in self._decoder.feed(data):
            if isinstance(event, Noise):
                self.rejects.add(event)
                continue
            self.received.append(event)
            for answer in self._answer(event):
                self.say(answer)

    def drain(self, _timeout: float) -> None:
        self.drained = len(self.received)

    def close(self) -> None:
        self.closed = True

    def reopen(self) -> LoopLine:
        return LoopLine(self._answer, self.clock)

    def _check(self) -> None:
        if self.closed:
            raise ClosedError(self.name, "it has been closed", "open it again")
        if self.lost:
            raise DisconnectedError(self.name, "the line was lost", "plug it in again")

    def _move(self) -> None:
        while self._arriving and self._arriving[0][0] <= self.clock.now():
            self._arrived += self._arriving.pop(0)[1]
        if self._arrived:
            self._readable()


def clock_of_the_loop() -> VirtualClock:
    """Return the clock of the loop that runs, or a new one where none does."""
    try:
        loop = asyncio.get_running_loop()
    except RuntimeError:
        return VirtualClock()
    assert isinstance(loop, VirtualLoop)
    return loop.clock


def client(line: LoopLine, **settings: Any) -> AsyncController:
    """Return a client on the time of its line."""
    return AsyncController(line, background=False, clock=line.clock.now, **settings)


def run(work: Coroutine[Any, Any, _Result], line: LoopLine | None = None) -> _Result:
    """Run a coroutine on the time of a line, or of those that it makes itself."""
    return run_virtual(work, VirtualClock() if line is None else line.clock)
