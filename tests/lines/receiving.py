"""What a board receives, in whatever time it lives, and what it answers."""

import json
from collections.abc import Callable, Iterator
from functools import cache
from importlib.resources import files
from typing import Any

import busservo
from busservo._envelopes import HEADS
from busservo._exchanges import EXCHANGES
from framewire.codec.rejects import Rejects


def answered(message: busservo.Message) -> list[busservo.Message]:
    """Return the answer of a board of servos 1 to 200, each at ten times its number."""
    if isinstance(message, busservo.BatteryVoltageRead):
        return [busservo.BatteryVoltage(7500)]
    if isinstance(message, busservo.ServoPositionsRead):
        return [busservo.ServoPositions([(servo, 10 * servo) for servo in message.servo_ids])]
    exchange = EXCHANGES.get(type(message))
    if exchange is None or exchange.reply is None:
        return []
    return [example_of(exchange.reply)]


def unanswered(_message: busservo.Message) -> list[busservo.Message]:
    return []


def example_of(kind: type[busservo.Message]) -> busservo.Message:
    """Return the first example of a message, as the vectors have it."""
    valid = _vectors()["valid"]
    text = next(each["hex"] for each in valid if each["message"] == kind.__name__)
    return kind.decode(bytes.fromhex(text))


@cache
def _vectors() -> Any:
    return json.loads(files("busservo").joinpath("vectors.json").read_text(encoding="utf-8"))


class Receiving:
    """The ear of a board: what it receives is kept, and what is no message is counted.

    What is `before` a method, by its name, is called first, and may wait or raise an error.
    """

    def __init__(self, **before: Callable[[], object]) -> None:
        self.received: list[busservo.Message] = []
        self.before = before
        # No client may ever make this count: see tests/lines/boards.py.
        self.rejects = Rejects(HEADS.begins)
        self._decoder = busservo.StreamDecoder(busservo.Direction.HOST_TO_CONTROLLER)

    def _begin(self, method: str) -> None:
        self.before.get(method, int)()

    def heard(self, data: bytes) -> Iterator[busservo.Message]:
        """Yield the messages that these bytes complete."""
        for event in self._decoder.feed(data):
            if isinstance(event, busservo.Noise):
                self.rejects.add(event)
                continue
            self.received.append(event)
            yield event
