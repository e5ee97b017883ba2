"""Whether `struct` packs a message from what is given, at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.model.slots import Constant, Items, Number

if TYPE_CHECKING:
    from framegen.model.layout import MessageLayout
    from framegen.model.slots import ByteOrder, Slot

# What packs so many elements is remembered for each number of them.
_MOST = 0xFF


def is_packed_at_once(message: MessageLayout, order: ByteOrder) -> bool:
    """Tell whether good values need no look but that of `struct`, which refuses all others.

    They are numbers that it knows, with the range of their type, and at most one list of such
    numbers, at the end, with its count. No checksum is to be worked out.
    """
    frame, slots = message.frame, [*message.body]
    if frame.tail or frame.checksums or frame.given or not message.arguments:
        return False
    if slots and isinstance(slots[-1], Items):
        items = slots.pop()
        if not isinstance(items, Items) or not _is_counted(items) or message.items is not items:
            return False
        slots += items.slots
    numbers = all(isinstance(slot, Number) and not slot.optional for slot in slots)
    return numbers and all(_is_packed(slot, order) for slot in (*frame.head, *slots))


def _is_counted(items: Items) -> bool:
    roles = [each.role for each in items.counters]
    return roles == ["count"] and not items.text and items.high <= _MOST


def _is_packed(slot: Slot, order: ByteOrder) -> bool:
    """Tell whether `struct` packs a slot as it is, and refuses what it may not be."""
    if isinstance(slot, Constant):
        return True
    if not isinstance(slot, Number) or slot.is_float or slot.narrowed or slot.role == "size":
        return False
    return slot.number_type.code != "" and (slot.size == 1 or slot.order == order)
