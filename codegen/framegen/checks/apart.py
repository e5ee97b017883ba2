"""What tells two frames of one direction apart: their constants and ids, and how long they are."""

from __future__ import annotations

from itertools import chain, combinations, product
from typing import TYPE_CHECKING

from framegen.model.slots import Constant, Number

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Slot


def alike(model: Model) -> Iterator[tuple[MessageLayout, MessageLayout]]:
    """Yield pairs of messages of one direction that no constant and no id tells apart."""
    for way in model.ways:
        # One without any legal count is too long: another rule speaks of it.
        sent = [message for message in model.sent(way) if message.counts]
        marks = {message.name: _marks(message) for message in sent}
        for one, other in _pairs(sent):
            if not _differ(marks[one.name], marks[other.name]):
                yield one, other


def _pairs(sent: Iterable[MessageLayout]) -> Iterator[tuple[MessageLayout, MessageLayout]]:
    """Pair messages that may be alike: those with the same ids, and those of different frames."""
    kinds: dict[str, dict[tuple[int, ...], list[MessageLayout]]] = {}
    for message in sent:
        kinds.setdefault(message.frame.name, {}).setdefault(_sent_ids(message), []).append(message)
    for groups in kinds.values():
        for group in groups.values():
            yield from combinations(group, 2)
    for some, others in combinations(kinds.values(), 2):
        all_of_some, all_of_others = ([*chain(*groups.values())] for groups in (some, others))
        if not _differ(*(_constants(each[0].frame.head) for each in (all_of_some, all_of_others))):
            yield from product(all_of_some, all_of_others)


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
    end = message.least - message.frame.tail_size
    found = _constants(slot for slot in message.slots if 0 <= slot.at < end)
    for slot in message.frame.head:
        if isinstance(slot, Number) and slot.role == "id":
            found |= enumerate(slot.write(message.id_of(slot)), slot.at)
    return found


def _constants(slots: Iterable[Slot]) -> dict[int, int]:
    found: dict[int, int] = {}
    for slot in slots:
        if isinstance(slot, Constant) and slot.role == "constant":
            found |= enumerate(slot.data, slot.at)
    return found


def _differ(one: dict[int, int], other: dict[int, int]) -> bool:
    return any(other.get(at, byte) != byte for at, byte in one.items())
