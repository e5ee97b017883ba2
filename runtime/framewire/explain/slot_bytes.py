"""What stands in the bytes of a frame, slot by slot; slow and plain."""

from __future__ import annotations

import struct

from ..protocol.places import from_front
from ..protocol.slots import Constant, Number, Packed, Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TypeAlias

    from ..protocol.envelope import Envelope
    from ..protocol.message import Message
    from ..protocol.places import Placed
    from ..protocol.slots import Slot

    # What a slot can hold.
    Value: TypeAlias = float | str | list[int]


def piece(placed: Placed, frame: bytes) -> bytes:
    """Return the bytes of a slot, as far as `frame` holds them."""
    return frame[placed.at : placed.end]


def read(number: Number, data: bytes) -> int:
    """Read a whole number from its bytes."""
    ordered = data if number.order == "big" else data[::-1]
    return int.from_bytes(ordered, "big", signed=number.signed)


def write(number: Number, value: int) -> bytes:
    """Write a whole number as bytes. Raises OverflowError where it does not fit."""
    data = value.to_bytes(number.size, "big", signed=number.signed)
    return data if number.order == "big" else data[::-1]


def read_in(number: Number, frame: bytes) -> int:
    """Read a whole number from `frame`, which holds all of it."""
    at = from_front(number.at, len(frame))
    return read(number, frame[at : at + number.size])


def is_in(slot: Slot, data: bytes) -> bool:
    """Tell whether `data` holds all of a slot; never, if it is placed from the end."""
    return 0 <= slot.at <= len(data) - slot.size


def value_of(slot: Number | Text | Packed, data: bytes) -> Value:
    """Return the value of its bytes: a number, a text, or all the numbers of a packed list."""
    if isinstance(slot, Text):
        text = data if slot.whole else data.rstrip(b"\0")
        return text.decode(slot.charset, "backslashreplace")
    if isinstance(slot, Packed):
        return _packed(slot, data)
    if not slot.is_float:
        return read(slot, data)
    (value,) = struct.unpack((">" if slot.order == "big" else "<") + "fd"[slot.size > 4], data)
    return float(value)


def _packed(slot: Packed, data: bytes) -> list[int]:
    whole = int.from_bytes(data if slot.order == "big" else data[::-1], "big")
    found = [whole >> slot.bits * at & (1 << slot.bits) - 1 for at in range(slot.count)]
    return found[::-1] if slot.order == "big" else found


def holds(slot: Slot, data: bytes) -> bool:
    """Tell whether a slot may have these bytes, as far as they tell it by themselves."""
    match slot:
        case Constant(role="constant"):
            return data == slot.data
        case Text():
            return data.isascii()
        case Packed():
            return all(slot.low <= each <= slot.high for each in _packed(slot, data))
        case Number():
            value = read(slot, data)
            # Addresses of a name may lie outside the range.
            named = slot.values.values() if slot.role == "address" else ()
            return slot.low <= value <= slot.high or any(each.value == value for each in named)
        case _:
            return True


def frame_length(envelope: Envelope, data: bytes) -> int:
    """Return the length of a frame that `data` begins; without a length part, its size."""
    return len(data) if envelope.length is None else read_in(envelope.length, data)


def legal_length(message: Message, data: bytes) -> int | None:
    """Return the legal length of the frame that `data` begins; None if there is none."""
    items, counter = message.items, message.counter
    if message.envelope.length is not None:
        length: int | None = read_in(message.envelope.length, data)
    elif items is None or counter is None:
        length = message.lengths[0]
    else:
        if not is_in(counter, data):
            return None
        step = items.size if counter.role == "size" else 1
        count, rest = divmod(read_in(counter, data), step)
        length = None if rest else message.base + items.size * count
    return length if length in message.lengths else None
