"""Devices for firmware tests, and what records what is written to them."""

from collections.abc import Callable, Iterator
from typing import Any

from framegen.conformance.device.step import column
from framegen.model.codec import encode, values_of
from framegen.model.exchanges import Exchange
from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.model.stream import ReferenceDecoder

from tests.lines.timed_line import Pieces, TimedLine

# What a device sends once it has received bytes: after how many seconds, and what.
Answer = Callable[[bytes], Pieces]


def lost_after(writes: int, answer: Answer) -> TimedLine:
    """Return a line whose cable is pulled after so many writes."""

    def answered(data: bytes) -> Pieces:
        if len(line.written) > writes:
            raise OSError("the cable was pulled")
        return answer(data)

    line = TimedLine(answered)
    return line


class Observed:
    """A transport that records what is written to the one behind it."""

    def __init__(self, behind: Any) -> None:
        self.written: list[bytes] = []
        self._behind = behind

    def read(self, timeout: float) -> bytes:
        data: bytes = self._behind.read(timeout)
        return data

    def write(self, data: bytes) -> None:
        self.written.append(data)
        self._behind.write(data)

    def close(self) -> None:
        self._behind.close()


def by_the_reference(model: Model, device: int | None = None) -> Answer:
    """Return a device that decodes as the reference does, and replies as the spec's examples do.

    It has every address, or that of a `device`. Where silence divides frames, each write is one.
    """
    held = b""
    line = ReferenceDecoder(model, [model.roles.sent])
    divided = is_divided(model)

    def answer(data: bytes) -> Pieces:
        nonlocal held
        held += data
        events = line.decode(held) if divided else line.decode_so_far(held)
        held = held[sum(len(event.data) for event in events) :]
        return [(0.001, reply) for event in events for reply in _replies(model, event, device)]

    return answer


def is_divided(model: Model) -> bool:
    """Tell whether silence divides frames: they have no header, or a longer one may come."""
    sent = model.sent(model.roles.sent)
    line = ReferenceDecoder(model, [model.roles.sent])
    frames = (frame for message in sent for frame in _any_number(message))
    return not all(each.frame.header for each in sent) or not all(map(line.decode_so_far, frames))


def _any_number(message: MessageLayout) -> Iterator[bytes]:
    """Yield the examples of a message, with each running number that a run may come to."""
    counter = message.frame.counter
    for example in message.message.examples:
        if counter is None:
            yield example.hex
        else:
            numbers = ({**example.values, counter.name: number} for number in range(64))
            yield from (encode(message, values) for values in numbers)


def answers_to(
    exchange: Exchange, reply: MessageLayout, requested: dict[str, Any]
) -> dict[str, Any]:
    """Return the values of an answer: of its first example, and what follows from the request."""
    values = dict(reply.message.examples[0].values)
    asked = {part.role: requested[part.name] for part in exchange.request.frame.given}
    values |= {part.name: asked[part.role] for part in reply.frame.given if part.role in asked}
    if reply is not exchange.reply:
        return values
    if exchange.failure is not None:
        values[exchange.failure.name] = exchange.good
    values = exchange.with_count(requested, values)
    for one, other in exchange.echoed:
        name, _, inner = other.partition(".")
        if inner:
            first = values[name][0]
            values[name] = [{**first, inner: value} for value in column(requested, one)]
        else:
            values[name] = requested[one]
    return values


def _replies(model: Model, event: Any, device: int | None) -> Iterator[bytes]:
    exchange = next((each for each in model.exchanges if each.request == event.message), None)
    if exchange is None or exchange.reply is None:
        return
    requested = values_of(exchange.request, event.data)
    if exchange.address is not None:
        to = requested[exchange.address.name]
        if to in exchange.address.silent or device not in (None, to):
            return
    yield encode(exchange.reply, answers_to(exchange, exchange.reply, requested))
