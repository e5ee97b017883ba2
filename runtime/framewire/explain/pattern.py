"""The general form of a message's frames: its parts in order, those of a list once."""

from __future__ import annotations

from dataclasses import dataclass

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from .protocol import Message, Slot


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
        if slot.role != "list":
            place = str(slot.at) if slot.at >= 0 else "end"
            data, text = _said(message, slot)
            yield Part(place, data, slot.size, slot.name, text, slot.order_in_words, slot.role)
            continue
        for field in slot.fields:
            place, path = place_in_each(slot, field.at), slot.path("i", field)
            data, text = _said(message, field)
            if "text" in slot.said:
                path, text = slot.name, "text"
            yield Part(place, data, field.size, path, text, field.order_in_words, "repeated")


def place_in_each(items: Slot, at: int = 0) -> str:
    """Return the offset of a number in each element of a list: `7 + 3i`."""
    step = "i" if items.size == 1 else f"{items.size}i"
    return f"{items.at + at} + {step}"


def _said(message: Message, slot: Slot) -> tuple[bytes | None, str]:
    """Return the bytes of a slot as far as they are known, and its value or its type."""
    if slot.role in ("constant", "reserved"):
        reserved = "reserved" if slot.role == "reserved" else ""
        return slot.data, ", ".join(filter(None, (reserved, slot.kind)))
    if slot.role == "id":
        number = message.ids[message.frame.ids.index(slot)]
        return slot.write(number), str(number)
    if slot.role == "length":
        return None if message.varies else slot.write(message.lengths[0]), message.formula
    absent = ", may be absent" if slot.said.get("optional") else ""
    return None, f"{slot.kind}{absent}"
