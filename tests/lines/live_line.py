"""A board at the end of a line in real time, that answers at once; its faults are hooks."""

import asyncio
import threading
from collections.abc import Callable, Coroutine
from functools import wraps
from typing import Any

from busservo import ClosedError, DisconnectedError, Message

from tests.lines.receiving import Receiving, answered
from tests.timeouts import GENEROUS

__all__ = ["LiveLine", "answered", "in_a_loop", "losing"]


class LiveLine(Receiving):
    """A transport whose reads block until there are bytes to read, or the time is over."""

    name = "live line"

    def __init__(
        self, answer: Callable[[Message], list[Message]] = answered, **before: Callable[[], object]
    ) -> None:
        super().__init__(**before)
        self.lost = False
        self.closed = False
        self.drained = 0
        self.reads = 0
        self._answer = answer
        self._arrived = b""
        self._changed = threading.Condition()

    def say(self, message: Message) -> None:
        with self._changed:
            self._arrived += message.encode()
            self._changed.notify_all()

    def unplug(self) -> None:
        with self._changed:
            self.lost = True
            self._changed.notify_all()

    def _check(self) -> None:
        if self.closed:
            raise ClosedError(self.name, "it has been closed", "open it again")
        if self.lost:
            raise DisconnectedError(self.name, "the line was lost", "plug it in again")

    def read(self, timeout: float) -> bytes:
        self.reads += 1
        self._begin("read")
        with self._changed:
            self._changed.wait_for(lambda: self._arrived or self.lost or self.closed, timeout)
            self._check()
            data, self._arrived = self._arrived, b""
            return data

    def write(self, data: bytes) -> None:
        self._begin("write")
        with self._changed:
            self._check()
            for message in self.heard(data):
                for answer in self._answer(message):
                    self._arrived += answer.encode()
            self._changed.notify_all()

    def drain(self, _timeout: float) -> None:
        self._begin("drain")
        self.drained = len(self.received)

    def close(self) -> None:
        with self._changed:
            self.closed = True
            self._changed.notify_all()
        self._begin("close")

    def reopen(self) -> "LiveLine":
        self._begin("reopen")
        return LiveLine(self._answer)


def losing(what: str = "the line was lost") -> Callable[[], None]:
    """Return a hook that raises what a line raises that was lost."""

    def lose() -> None:
        raise DisconnectedError(LiveLine.name, what, "plug it in again")

    return lose


def in_a_loop(test: Callable[..., Coroutine[Any, Any, None]]) -> Callable[..., None]:
    """Run a test that is a coroutine, in real time; none may wait for ever."""

    @wraps(test)
    def ran(**fixtures: Any) -> None:
        async def bounded() -> None:
            await asyncio.wait_for(test(**fixtures), 2 * GENEROUS)

        asyncio.run(bounded())

    return ran
