"""Examples for the page about stream decoding: real bytes, made from those of the spec."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.explanation.refusals import COUNT_MISMATCH
from framegen.model.codec import Unencodable, encode
from framegen.model.slots import Constant
from framegen.targets.docs.walkthrough import Walkthrough, walkthrough

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# Lists longer than this make no good picture.
_LONGEST_LIST = 8


@dataclass(frozen=True, slots=True)
class StreamExample:
    """One walk-through, and what it shows."""

    id: str
    title: str
    text: str
    walkthrough: Walkthrough


# What each example is called, and what it teaches.
_SAID = {
    "whole": (
        "A frame, as it arrives",
        """Every byte either agrees with those before it or rules out a frame. A frame that is left
        at the end is as certain as it can be without a checksum.""",
    ),
    "extra-byte": (
        "A single header byte before a frame",
        """The extra byte makes a header of itself and the next, so length and command are read one
        byte too early. They disagree, the false header costs one byte, and the frame is found.""",
    ),
    "count": (
        "A false header that only the count gives away",
        """Here length and command agree by accident. Only the count says that this is no frame. A
        decoder that trusts the length would wait for bytes that are not its own.""",
    ),
    "unknown": (
        "An unknown command",
        """A length is only as good as the command that it comes with. An unknown command costs one
        byte like any false header, so it never swallows the frame behind it.""",
    ),
    "cut-short": (
        "A frame cut short, and silence",
        """The decoder waits for the rest of a frame. When the line goes quiet, it is flushed: it
        gives the false start up, and searches the bytes that it held back.""",
    ),
}


def stream_examples(model: Model) -> list[StreamExample]:
    """Return the examples that this protocol allows, the easiest first."""
    return [
        StreamExample(
            id_, _SAID[id_][0], " ".join(_SAID[id_][1].split()), walkthrough(model, way, data)
        )
        for id_, way, data in _materials(model)
        if data is not None
    ]


def _materials(model: Model) -> Iterator[tuple[str, Direction, bytes | None]]:
    way = model.directions[0]
    frames = _frames(model, way)
    if not frames:
        return
    first, short = frames[0], min(frames, key=len)
    head = _unknown_head(model, way)
    yield "whole", way, first
    yield "extra-byte", way, model.frame.header[-1:] + first
    yield "count", way, _misread(model, way)
    yield "unknown", way, None if head is None else head + short
    yield "cut-short", way, first[:-1]


def _frames(model: Model, way: Direction) -> list[bytes]:
    messages = model.sent(way)
    return [example.hex for message in messages for example in message.message.examples]


def _misread(model: Model, way: Direction) -> bytes | None:
    """Find a frame that, behind a false header byte, begins like a frame of another length."""
    for message in model.sent(way):
        for frame in _lengthened(message):
            data = model.frame.header[-1:] + frame
            events = walkthrough(model, way, data).events
            if [event.reason for event in events] == [COUNT_MISMATCH, ""]:
                return data
    return None


def _lengthened(message: MessageLayout) -> Iterator[bytes]:
    """Yield the first example of a message, with lists of other lengths."""
    items, examples = message.items, message.message.examples
    if items is None or not examples:
        return
    values = examples[0].values
    for count in message.counts[:_LONGEST_LIST]:
        listed = [(values[items.name] or [None])[0]] * count
        try:
            yield encode(message, {**values, items.name: listed})
        except Unencodable:
            return


def _unknown_head(model: Model, way: Direction) -> bytes | None:
    """Make the head of a frame with an unknown id and the largest length."""
    frame, sent = model.frame, model.sent(way)
    known = {message.id for message in sent}
    code = next((code for code in frame.legal_ids if code not in known and code), None)
    if code is None:
        return None
    length = max(message.lengths[-1] for message in sent)
    return b"".join(
        slot.data
        if isinstance(slot, Constant)
        else slot.write(code if slot.role == "id" else length)
        for slot in frame.head
    )
