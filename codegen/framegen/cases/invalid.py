"""Invalid frames with the reason: every documented frame, with one thing wrong at a time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.cases.unknown_id import unknown_id
from framegen.model.slots import Constant, Number
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Placed


@dataclass(frozen=True, slots=True)
class InvalidFrame:
    """Bytes that are no frame, the reason, and the offset where it shows."""

    title: str
    direction: Direction
    data: bytes
    reason: str
    offset: int


def invalid_frames(model: Model) -> Iterator[InvalidFrame]:
    """Yield every example of the spec, spoilt in every way; no bytes twice."""
    for direction in model.directions:
        seen: set[bytes] = set()
        for message in model.sent(direction):
            for example in message.message.examples:
                for title, data in spoilt(model, message, example.hex):
                    if data in seen:
                        continue
                    seen.add(data)
                    said = weigh_whole(model, [direction], data)
                    if said.message is None:
                        what = f"{message.name}: {title}"
                        yield InvalidFrame(what, direction, data, said.reason, said.offset)


def spoilt(model: Model, message: MessageLayout, frame: bytes) -> Iterator[tuple[str, bytes]]:
    """Yield copies of a frame with one thing wrong in each; some may still be legal frames."""
    envelope = model.frame
    for size in sorted({0, 1, len(envelope.header), envelope.body_at - 1, len(frame) - 1}):
        yield f"only the first {size} bytes", frame[:size]
    yield "a byte too many", frame + b"\x00"
    for placed in slots_once(message, frame):
        for title, data in spoilt_slot(model, message, placed, placed.of(frame)):
            wrong = frame[: placed.at] + data
            yield title, wrong + frame[placed.end :]
            if placed.at >= envelope.body_at and placed.end < len(frame):
                yield f"{title}, and nothing behind it", wrong


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
    if isinstance(slot, Constant):
        yield "a header byte flipped", data[:-1] + bytes([data[-1] ^ 0xFF])
    if not isinstance(slot, Number):
        return
    match slot.role:
        case "length" | "count":
            for step in -1, 1:
                value = (slot.read(data) + step) % (slot.number_type.high + 1)
                yield f"the {slot.role} off by {step:+}", slot.write(value)
        case "id":
            unknown = unknown_id(model, message.direction)
            if unknown is not None:
                yield "an unknown command", slot.write(unknown)
        case _:
            if slot.high < slot.number_type.high:
                yield f"{placed.path} too high", slot.write(slot.high + 1)
            if slot.low > slot.number_type.low:
                yield f"{placed.path} too low", slot.write(slot.low - 1)
