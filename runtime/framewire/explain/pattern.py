"""The general form of a message's frames: its parts in order, those of a list once."""

from __future__ import annotations

from dataclasses import dataclass

from ..protocol.slots import Constant, List, Number
from .slot_bytes import write
from .words import kind_in_words, order_in_words

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..protocol.message import Message
    from ..protocol.slots import Slot


@dataclass(frozen=True)
class Part:
    """Some bytes of every frame that belong together.

    `place` is their offset: `7 + 3i` in a list, `end` behind the fields. `data` is None where
    frames differ. `text` is their value, their type, or the rule that they follow, and `order` says
    which byte of a number comes first.
    """

    place: str
    data: bytes | None
    size: int
    path: str
    text: str
    order: str
    role: str


def pattern(message: Message) -> Iterator[Part]:
    """Yield the parts of any frame of a message."""
    for slot in message.slots:
        if not isinstance(slot, List):
            place = str(slot.at) if slot.at >= 0 else "end"
            data, text = _said(message, slot)
            yield Part(place, data, slot.size, slot.name, text, order_in_words(slot), slot.role)
            continue
        for field in slot.fields:
            place, path = place_in_each(slot, field.at), slot.path("i", field)
            data, text = _said(message, field)
            if slot.text:
                path, text = slot.name, "text"
            yield Part(place, data, field.size, path, text, order_in_words(field), "repeated")


def place_in_each(items: List, at: int = 0) -> str:
    """Return the offset of a number in each element of a list: `7 + 3i`."""
    step = "i" if items.size == 1 else f"{items.size}i"
    return f"{items.at + at} + {step}"


def _said(message: Message, slot: Slot) -> tuple[bytes | None, str]:
    """Return the bytes of a slot as far as they are known, and its value or its type."""
    if isinstance(slot, Constant):
        reserved = "reserved" if slot.role == "reserved" else ""
        return slot.data, ", ".join(filter(None, (reserved, kind_in_words(slot))))
    if not isinstance(slot, Number):
        return None, kind_in_words(slot)
    if slot.role == "id":
        number = message.ids[message.envelope.ids.index(slot)]
        return write(slot, number), str(number)
    if slot.role == "length":
        return None if message.varies else write(slot, message.lengths[0]), message.formula
    return None, f"{kind_in_words(slot)}{', may be absent' if slot.optional else ''}"
