"""Timing: how long frames take on the line, and how many of them it carries in a second."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.pluralize import pluralize

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class FrameTiming:
    """One size of a message: its contents, its bytes, and its time on the line."""

    message: str
    what: str
    size: int
    milliseconds: str
    a_second: str


@dataclass(frozen=True, slots=True)
class RoundTrip:
    """A request and its reply without a pause: the best that the line allows."""

    request: str
    reply: str
    what: str
    size: int
    milliseconds: str
    a_second: str


def milliseconds(seconds: float) -> str:
    """Write a time as `35.4 ms`."""
    return f"{seconds * 1000:.1f} ms"


def bytes_a_second(model: Model) -> str:
    """Return the bytes a second that the line carries, as text: `960`."""
    link = model.spec.link
    return _trimmed(link.baud / link.bits_per_byte)


def timings(model: Model) -> list[FrameTiming]:
    """Return the times of every message at its smallest, as in its examples, and at its largest."""
    return [
        _timing(message, count) for message in model.messages.values() for count in _sizes(message)
    ]


def round_trips(model: Model) -> list[RoundTrip]:
    """Return the times of every request with its reply, lists of both at the same count."""
    return [trip for message in model.messages.values() for trip in _trips(model, message)]


def _trips(model: Model, request: MessageLayout) -> Iterator[RoundTrip]:
    if request.message.reply is None:
        return
    reply = model.messages[request.message.reply]
    for count in _sizes(request):
        answered = min(max(count, reply.counts[0]), reply.counts[-1])
        size = request.size_at(count) + reply.size_at(answered)
        seconds = request.wire_seconds(size)
        what = _what(request, count)
        if request.items is not None and answered < count:
            what += f", {answered} of them answered"
        yield RoundTrip(
            request.name, reply.name, what, size, milliseconds(seconds), _trimmed(1 / seconds)
        )


def _timing(message: MessageLayout, count: int) -> FrameTiming:
    size = message.size_at(count)
    seconds = message.wire_seconds(size)
    what = _what(message, count)
    return FrameTiming(message.name, what, size, milliseconds(seconds), _trimmed(1 / seconds))


def _sizes(message: MessageLayout) -> list[int]:
    """Return the counts worth showing: the fewest, those of the examples, the most."""
    items = message.items
    if items is None:
        return [*message.counts]
    shown = [len(example.values[items.name]) for example in message.message.examples]
    return sorted({message.counts[0], *shown, message.counts[-1]})


def _what(message: MessageLayout, count: int) -> str:
    if message.items is not None:
        what = "character" if message.items.text else "item"
        return f"{pluralize(count, what)} in {message.items.name}"
    absent = [slot.name for slot in message.optional if slot not in message.there(count)]
    return f"without {', '.join(absent)}" if absent else ""


def _trimmed(number: float) -> str:
    return f"{number:.1f}".removesuffix(".0")
