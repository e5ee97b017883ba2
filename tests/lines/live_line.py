"""A board at the end of a line in real time, that answers at once."""

from __future__ import annotations

import json
import threading
from importlib.resources import files
from typing import TYPE_CHECKING

from busservo import (
    BatteryVoltage,
    BatteryVoltageRead,
    ClosedError,
    Direction,
    DisconnectedError,
    Message,
    Noise,
    ServoPositions,
    ServoPositionsRead,
    StreamDecoder,
)
from busservo._client.exchanges import EXCHANGES
from busservo._codec.rejects import Rejects

if TYPE_CHECKING:
    from collections.abc import Callable


def answered(message: Message) -> list[Message]:
    """Return the answer of a board of servos 1 to 200, each at ten times its number."""
    if isinstance(message, BatteryVoltageRead):
        return [BatteryVoltage(7500)]
    if isinstance(message, ServoPositionsRead):
        return [ServoPositions([(servo, 10 * servo) for servo in message.servo_ids])]
    exchange = EXCHANGES.get(type(message))
    if exchange is None or exchange.reply is None:
        return []
    return [example_of(exchange.reply)]


def example_of(kind: type[Message]) -> Message:
    """Return the first example of a message, as the vectors have it."""
    vectors = json.loads(files("busservo").joinpath("vectors.json").read_text(encoding="utf-8"))
    return next(
        kind.decode(bytes.fromhex(vector["hex"]))
        for vector in vectors["valid"]
        if vector["message"] == kind.__name__
    )


class LiveLine:
    """A transport whose reads block until there are bytes to read, or the time is over."""

    name = "live line"

    def __init__(self, answer: Callable[[Message], list[Message]] = answered) -> None:
        self.received: list[Message] = []
        self.lost = False
        self.closed = False
        self.drained = 0
        self._answer = answer
        # No client may ever make this count: see tests/conftest.py.
        self.rejects = Rejects()
        self._decoder = StreamDecoder(Direction.HOST_TO_CONTROLLER)
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
        with self._changed:
            self._changed.wait_for(lambda: self._arrived or self.lost or self.closed, timeout)
            self._check()
            data, self._arrived = self._arrived, b""
            return data

    def write(self, data: bytes) -> None:
        with self._changed:
            self._check()
            for event in self._decoder.feed(data):
                if isinstance(event, Noise):
                    self.rejects.add(event)
                    continue
                self.received.append(event)
                for answer in self._answer(event):
                    self._arrived += answer.encode()
            self._changed.notify_all()

    def drain(self, _timeout: float) -> None:
        self.drained = len(self.received)

    def close(self) -> None:
        with self._changed:
            self.closed = True
            self._changed.notify_all()

    def reopen(self) -> LiveLine:
        return LiveLine(self._answer)
