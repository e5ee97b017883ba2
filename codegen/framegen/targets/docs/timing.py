"""Timing: how long frames take on the line, and how many of them it carries in a second."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
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
    """Return the times of every request with its reply, at the sizes worth showing of both."""
    # Where a reply lists what was asked for, it has as many elements, as far as there is room.
    listing = {exchange.request.name for exchange in model.exchanges if exchange.most}
    return [
        _trip(request, reply, count, answered, is_listed=request.name in listing)
        for request in model.messages.values()
        if request.message.reply is not None
        for reply in [model.messages[request.message.reply]]
        for count in _sizes(request)
        for answered in _answers(reply, count, is_listed=request.name in listing)
    ]


def _answers(reply: MessageLayout, count: int, *, is_listed: bool) -> list[int]:
    """Return the counts of a reply to a request with so many elements."""
    if is_listed:
        return [min(max(count, reply.counts[0]), reply.counts[-1])]
    return sorted({reply.counts[0], reply.counts[-1]})


def _trip(
    request: MessageLayout, reply: MessageLayout, count: int, answered: int, *, is_listed: bool
) -> RoundTrip:
    size = request.size_at(count) + reply.size_at(answered)
    seconds = request.wire_seconds(size)
    what = [_what(request, count)]
    if not is_listed and len(reply.counts) > 1:
        what.append(_what(reply, answered))
    elif is_listed and answered < count:
        what.append(f"{answered} of them answered")
    said = ", ".join(filter(None, what))
    return RoundTrip(
        request.name, reply.name, said, size, milliseconds(seconds), _trimmed(1 / seconds)
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
