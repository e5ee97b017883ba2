"""What tells two frames of one direction apart: their constants and ids, and how long they are."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

from framegen.model.slots import Constant, Number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


def alike(model: Model) -> Iterator[tuple[MessageLayout, MessageLayout]]:
    """Yield pairs of messages of one direction that no constant and no id tells apart."""
    for way in model.ways:
        # One without any legal count is too long: another rule speaks of it.
        sent = [message for message in model.sent(way) if message.counts]
        groups: dict[tuple[int, ...], list[MessageLayout]] = {}
        for message in sent:
            groups.setdefault(_sent_ids(message), []).append(message)
        one_kind = len({message.frame.name for message in sent}) == 1
        for group in groups.values() if one_kind else [sent]:
            for one, other in combinations(group, 2):
                if not _differ(_marks(one), _marks(other)):
                    yield one, other


def shared_size(one: MessageLayout, other: MessageLayout) -> int | None:
    """Return the smallest size that frames of both can have; None where there is none."""
    sizes, others = _sizes(one), _sizes(other)
    return next((size for size in sizes if size in others), None)


def _sizes(message: MessageLayout) -> range | list[int]:
    if isinstance(message.lengths, range):
        by, lengths = message.frame.uncounted, message.lengths
        return range(lengths.start + by, lengths.stop + by, lengths.step)
    return [length + message.frame.uncounted for length in message.lengths]


def _sent_ids(message: MessageLayout) -> tuple[int, ...]:
    return tuple(
        message.id_of(part) for part in message.frame.ids if part not in message.frame.unsent
    )


def _marks(message: MessageLayout) -> dict[int, int]:
    """Return the bytes that every frame of a message has, by offset."""
    found: dict[int, int] = {}
    for slot in message.slots:
        if slot.at < 0 or slot.at >= message.least - message.frame.tail_size:
            continue
        data = b""
        if isinstance(slot, Constant) and slot.role == "constant":
            data = slot.data
        elif isinstance(slot, Number) and slot.role == "id":
            data = slot.write(message.id_of(slot))
        found |= dict(enumerate(data, slot.at))
    return found


def _differ(one: dict[int, int], other: dict[int, int]) -> bool:
    return any(other.get(at, byte) != byte for at, byte in one.items())
