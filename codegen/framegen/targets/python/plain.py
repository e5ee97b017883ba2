"""Whether a protocol is plain: the simplest kind, whose library is made of less."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from framegen.model.slots import Constant, Items, Number

if TYPE_CHECKING:
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import ByteOrder, Slot


@lru_cache(maxsize=4)
def is_plain(model: Model) -> bool:
    """Tell whether a protocol is plain.

    It has one envelope: a constant, one length and one id, and behind them the fields. These are
    numbers that `struct` knows, and at most one list of them, at the end, with its count.
    """
    if len(model.envelopes) > 1:
        return False
    frame, order = model.frame, model.spec.byte_order
    roles = [slot.role for slot in frame.head]
    if frame.tail or frame.unsent or sorted(roles) != ["constant", "id", "length"]:
        return False
    if roles[0] != "constant" or not all(_is_plain(slot, order) for slot in frame.head):
        return False
    return all(_has_plain_fields(message, order) for message in model.messages.values())


def _has_plain_fields(message: MessageLayout, order: ByteOrder) -> bool:
    slots: list[Slot] = [*message.body]
    if slots and isinstance(slots[-1], Items):
        items = slots.pop()
        counters = [each.role for each in items.counters] if isinstance(items, Items) else []
        if counters != ["count"] or message.items is not items or items.text:
            return False
        slots += items.slots
    return all(
        isinstance(slot, Number) and not slot.optional and _is_plain(slot, order) for slot in slots
    )


def _is_plain(slot: Slot, order: ByteOrder) -> bool:
    if isinstance(slot, Constant):
        return slot.field is None and slot.role == "constant"
    if not isinstance(slot, Number) or slot.is_float or slot.role == "size":
        return False
    return slot.number_type.code != "" and (slot.size == 1 or slot.order == order)
