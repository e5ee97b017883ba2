"""Examples for the page about stream decoding: real bytes, made from those of the spec."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.explain.refusals import BAD_CHECKSUM, COUNT_MISMATCH

from framegen.model.codec import Unencodable, encode
from framegen.model.slots import Constant, Number
from framegen.model.verdict import weigh
from framegen.targets.docs.walkthrough import Walkthrough, walkthrough

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
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
    "proven": (
        "A frame, as it arrives",
        """Every byte either agrees with those before it or rules out a frame. What is left at the
        end is proven by its checksum.""",
    ),
    "checksum": (
        "A frame with a wrong byte",
        """All looks well up to the checksum, which does not agree. The frame costs one byte, and so
        does whatever else in it begins as a frame does: what is behind it is not lost.""",
    ),
    "extra-byte": (
        "A single header byte before a frame",
        """The extra byte makes a header of itself and the next, so length and command are read one
        byte too early. They disagree, the false header costs one byte, and the frame is found.""",
    ),
    "stray-byte": (
        "A stray byte before a frame",
        """The byte begins no frame, or none that stays possible. It costs one byte, and the frame
        behind it is found.""",
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
    "certain": (
        "An unknown command, proven",
        """Newer firmware may send what nobody has written down. The checksum agrees, so this is a
        frame and no noise: it is reported as an unknown frame.""",
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
    way = next((way for way in model.directions if _frames(model, way)), None)
    if way is None:
        return
    frames = _frames(model, way)
    (layout, first), (_, short) = frames[0], min(frames, key=lambda each: len(each[1]))
    frame = layout.frame
    yield "proven" if frame.proven else "whole", way, first
    if frame.proven:
        spoilt = (_spoilt(model, way, data, short) for _, data in frames)
        yield "checksum", way, next(filter(None, spoilt), None)
    begins_alike = frame.header and len(frame.header) > 1 and not frame.proven
    if begins_alike:
        yield "extra-byte", way, frame.header[-1:] + first
    elif frame.header:
        yield "stray-byte", way, frame.header[-1:] + first
    if frame.length_part is not None and frame.id_part is not None:
        yield from _of_lengths(model, way, frame, short)
    yield "cut-short", way, first[:-1]


def _of_lengths(
    model: Model, way: Direction, frame: Envelope, short: bytes
) -> Iterator[tuple[str, Direction, bytes | None]]:
    """Yield what shows how far a length is trusted."""
    yield "count", way, _misread(model, way)
    if frame.proves_unknown:
        yield "certain", way, _unknown_frame(model, way, frame)
    elif not frame.proven:
        head = _unknown_head(model, way, frame)
        yield "unknown", way, None if head is None else head + short


def _frames(model: Model, way: Direction) -> list[tuple[MessageLayout, bytes]]:
    messages = model.sent(way)
    return [(message, each.hex) for message in messages for each in message.message.examples]


def _spoilt(model: Model, way: Direction, frame: bytes, behind: bytes) -> bytes | None:
    """Change a byte of a frame that nothing but its checksum shows, with a frame behind it."""
    for at in range(len(frame) - 1, -1, -1):
        data = frame[:at] + bytes([frame[at] ^ 1]) + frame[at + 1 :]
        verdict = weigh(model, [way], data)
        if verdict.reason == BAD_CHECKSUM and at < verdict.offset:
            return data + behind
    return None


def _misread(model: Model, way: Direction) -> bytes | None:
    """Find a frame that, behind a false header byte, begins like a frame of another length."""
    for message in model.sent(way):
        for frame in _lengthened(message):
            data = message.frame.header[-1:] + frame
            events = walkthrough(model, way, data).events
            if [event.reason for event in events] == [COUNT_MISMATCH, ""]:
                return data
    return None


def _lengthened(message: MessageLayout) -> Iterator[bytes]:
    """Yield the first example of a message, with lists of other lengths."""
    items, examples = message.items, message.message.examples
    if items is None or items.text or not items.counters or not examples:
        return
    values = examples[0].values
    for count in message.counts[:_LONGEST_LIST]:
        listed = [(values[items.name] or [None])[0]] * count
        try:
            yield encode(message, {**values, items.name: listed})
        except Unencodable:
            return


def _unknown_head(model: Model, way: Direction, frame: Envelope) -> bytes | None:
    """Make the head of a frame with an unknown id and the largest length."""
    sent = [message for message in model.sent(way) if message.frame is frame]
    known = {message.id for message in sent}
    code = next((code for code in frame.legal_ids if code not in known and code), None)
    if code is None:
        return None
    length = max(message.lengths[-1] for message in sent)
    return b"".join(_head_slot(slot, code, length) for slot in frame.head)


def _head_slot(slot: Constant | Number, code: int, length: int) -> bytes:
    if isinstance(slot, Constant):
        return slot.data
    given = {"id": code, "length": length}
    return slot.write(given.get(slot.role, slot.low))


def _unknown_frame(model: Model, way: Direction, frame: Envelope) -> bytes | None:
    """Make a whole frame of an unknown id without any field, with the right checksums."""
    head = _unknown_head(model, way, frame)
    if head is None or not isinstance(frame.length_part, Number):
        return None
    at, length = frame.length.at, frame.length.write(frame.counted)
    tail = b"".join(
        slot.data if isinstance(slot, Constant) else bytes(slot.size) for slot in frame.tail
    )
    data = bytearray(head[:at] + length + head[at + len(length) :] + tail)
    for checksum in frame.checksums:
        place = checksum.at if checksum.at >= 0 else len(data) + checksum.at
        covered = frame.covered(checksum, {})
        data[place : place + checksum.size] = covered.checksum(checksum, bytes(data))
    return bytes(data) if weigh(model, [way], bytes(data)).proven else None
