"""Invalid frames with the reason: every documented frame, with one thing wrong at a time."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING

from framegen.cases.unknown_id import unknown_id
from framegen.cases.valid import frames_of
from framegen.model.slots import Constant, Number, Packed, Text
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Placed

# A character that no text has, as a byte.
_FOREIGN = 0xE9


@dataclass(frozen=True, slots=True)
class InvalidFrame:
    """Bytes that are no frame, the reason, and the offset where it shows."""

    title: str
    direction: Direction
    data: bytes
    reason: str
    offset: int


def invalid_frames(model: Model) -> Iterator[InvalidFrame]:
    """Yield every example of the spec, spoilt in every way; no bytes twice.

    A message without examples is shown at the lower ends of its ranges.
    """
    for direction in model.directions:
        seen: set[bytes] = set()
        for message in model.sent(direction):
            for frame in _frames(message):
                for title, data in spoilt(model, message, frame):
                    if data in seen:
                        continue
                    seen.add(data)
                    said = weigh_whole(model, [direction], data)
                    if said.message is None:
                        what = f"{message.name}: {title}"
                        yield InvalidFrame(what, direction, data, said.reason, said.offset)


def _frames(message: MessageLayout) -> Iterator[bytes]:
    examples = message.message.examples
    yield from (example.hex for example in examples)
    if not examples:
        yield from (frame.data for frame in islice(frames_of(message), 1))


def spoilt(model: Model, message: MessageLayout, frame: bytes) -> Iterator[tuple[str, bytes]]:
    """Yield copies of a frame with one thing wrong in each; some may still be legal frames."""
    envelope = message.frame
    ends = {0, 1, len(envelope.header), envelope.body_at - 1, len(frame) - 1}
    if envelope.tail:
        ends.add(len(frame) - envelope.tail_size)
    for size in sorted(ends):
        yield f"only the first {size} bytes", frame[:size]
    yield "a byte too many", frame + b"\x00"
    for placed in slots_once(message, frame):
        for title, data in spoilt_slot(model, message, placed, placed.of(frame)):
            wrong = frame[: placed.at] + data
            yield title, wrong + frame[placed.end :]
            if placed.at >= envelope.body_at and placed.end < len(frame):
                yield f"{title}, and nothing behind it", wrong
            if envelope.checksums and placed.slot.role != "checksum":
                right = message.sealed(wrong + frame[placed.end :])
                yield f"{title}, and the checksum of that", right
    if envelope.checksums:
        yield from _changed(message, frame)


def _changed(message: MessageLayout, frame: bytes) -> Iterator[tuple[str, bytes]]:
    """Yield copies of a frame of which a covered slot is another, but no checksum is."""
    for placed in slots_once(message, frame):
        slot = placed.slot
        if isinstance(slot, Number | Packed | Text) and slot.role not in ("checksum", "length"):
            data = placed.of(frame)
            # Of a number, the lowest bit: as a rule, it stays in its range.
            at = 0 if getattr(slot, "order", "little") == "little" else len(data) - 1
            other = data[:at] + bytes([data[at] ^ 1]) + data[at + 1 :]
            wrong = frame[: placed.at] + other + frame[placed.end :]
            yield f"{placed.path} with a bit flipped", wrong


def slots_once(message: MessageLayout, frame: bytes) -> Iterator[Placed]:
    """Yield the slots of a legal frame with their places; of a list, the first element's."""
    seen: set[int] = set()
    for placed in message.lay_out(message.count_of(frame)):
        if id(placed.slot) not in seen:
            seen.add(id(placed.slot))
            yield placed


def spoilt_slot(
    model: Model, message: MessageLayout, placed: Placed, data: bytes
) -> Iterator[tuple[str, bytes]]:
    """Yield the bytes of one slot, wrong in every way that its role allows."""
    slot = placed.slot
    match slot:
        case Constant(role="constant"):
            what = "a header byte" if placed.at < message.frame.body_at else placed.path
            yield f"{what} flipped", data[:-1] + bytes([data[-1] ^ 0xFF])
        case Text():
            yield f"{placed.path} with a foreign character", bytes([_FOREIGN]) + data[1:]
        case Packed():
            for word, value in ("high", slot.high + 1), ("low", slot.low - 1):
                if 0 <= value <= slot.number_type.high:
                    values = [value, *slot.values(data)[1:]]
                    yield f"{placed.path} too {word}", slot.write(values)
        case Number():
            yield from _spoilt_number(model, message, placed, slot, data)


def _spoilt_number(
    model: Model, message: MessageLayout, placed: Placed, slot: Number, data: bytes
) -> Iterator[tuple[str, bytes]]:
    match slot.role:
        case "length" | "count" | "size":
            for step in -1, 1:
                value = (slot.read(data) + step) % (slot.number_type.high + 1)
                yield f"the {slot.role} off by {step:+}", slot.write(value)
        case "id":
            unknown = unknown_id(model, message.direction, message.frame, slot)
            if unknown is not None:
                yield "an unknown command", slot.write(unknown)
        case "checksum":
            for step in -1, 1:
                value = (slot.read(data) + step) % (slot.number_type.high + 1)
                yield f"the {placed.path} off by {step:+}", slot.write(value)
            yield f"the {placed.path} in the other byte order", data[::-1]
        case _:
            for word, value in ("high", slot.high + 1), ("low", slot.low - 1):
                typed = slot.number_type.low <= value <= slot.number_type.high
                if typed and not slot.holds(value):
                    yield f"{placed.path} too {word}", slot.write(value)
