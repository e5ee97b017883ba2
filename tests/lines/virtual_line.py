"""A line and a board in one, in virtual time: a read moves the clock on, and nothing sleeps."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING

from busservo import Direction, Message, Noise, StreamDecoder
from busservo._codec.rejects import Rejects

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    Answer = Callable[[Message], Iterable["tuple[float, bytes | Message]"]]


def nothing(_message: Message) -> list[tuple[float, bytes | Message]]:
    return []


class VirtualLine:
    """A transport whose other end answers as `answer` returns: bytes, each after a delay.

    Bytes arrive in the order in which they were sent, whatever their delays.
    """

    name = "virtual line"

    def __init__(self, answer: Answer = nothing) -> None:
        self.now = 0.0
        self.answer = answer
        self.received: list[Message] = []
        self.sent_at: list[float] = []
        self.closed = False
        self.drained = False
        self.error: Exception | None = None
        # No client may ever make this count: see tests/conftest.py.
        self.rejects = Rejects()
        self._decoder = StreamDecoder(Direction.HOST_TO_CONTROLLER)
        self._arriving: list[tuple[float, int, bytes]] = []
        self._number = 0
        self._last = 0.0

    def clock(self) -> float:
        return self.now

    def say(self, data: bytes | Message, delay: float = 0.0) -> None:
        """Let bytes arrive, `delay` seconds from now."""
        at = self._last = max(self._last, self.now + delay)
        self._number += 1
        octets = data if isinstance(data, bytes) else data.encode()
        heapq.heappush(self._arriving, (at, self._number, octets))

    def read(self, timeout: float) -> bytes:
        if self.error is not None:
            raise self.error
        # However short the wait, time goes on: or else a client that polls would stand still.
        until = self.now + max(timeout, 1e-6)
        if not self._arriving or self._arriving[0][0] > until:
            self.now = until
            return b""
        self.now = max(self.now, self._arriving[0][0])
        data = b""
        while self._arriving and self._arriving[0][0] <= self.now:
            data += heapq.heappop(self._arriving)[2]
        return data

    def write(self, data: bytes) -> None:
        if self.error is not None:
            raise self.error
        for event in self._decoder.feed(data):
            if isinstance(event, Noise):
                self.rejects.add(event)
                continue
            self.received.append(event)
            self.sent_at.append(self.now)
            for delay, answer in self.answer(event):
                self.say(answer, delay)

    def drain(self, _timeout: float) -> None:
        self.drained = True

    def close(self) -> None:
        self.closed = True
