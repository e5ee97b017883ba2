"""What tells two frames of one direction apart: a byte that differs, and how long they are."""

from __future__ import annotations

from itertools import chain, combinations, product, repeat
from typing import TYPE_CHECKING

from framegen.model.checksums import CHECKSUMS
from framegen.model.slots import Constant, Number, Text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Placed, Slot

_ANY, _ASCII = range(256), range(128)


def alike(model: Model) -> Iterator[tuple[MessageLayout, MessageLayout]]:
    """Yield pairs of messages of one direction that no byte tells apart."""
    for way in model.ways:
        # One without any legal count is too long: another rule speaks of it.
        sent = [message for message in model.sent(way) if message.counts]
        marks: dict[str, dict[int, range]] = {}
        for one, other in _pairs(sent):
            # Most messages have an id of their own, and are in no pair.
            for message in (one, other):
                if message.name not in marks:
                    marks[message.name] = _marks(message)
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


def begun(model: Model) -> Iterator[tuple[MessageLayout, MessageLayout]]:
    """Yield pairs of messages, of which a frame of the second may begin with one of the first.

    Neither a byte nor a length tells them apart: only a checksum may.
    """
    for one, other in alike(model):
        short, long = sorted((one, other), key=lambda message: message.least)
        is_sized = one.frame is other.frame and one.frame.length_part is not None
        if not is_sized and short.least < long.largest:
            yield short, long


def shares_checksums(short: MessageLayout, long: MessageLayout) -> bool:
    """Tell whether what proves the shorter of two messages is right in every frame of both."""
    return {*_proofs(short)} <= {*_proofs(long)}


def _proofs(message: MessageLayout) -> Iterator[tuple[object, ...]]:
    """Yield the checksums of a message's smallest frame: how and where, and what they cover."""
    frame, size = message.frame, message.least
    ids = dict(zip((part.name for part in frame.ids), message.ids, strict=True))
    for part in frame.checksums:
        pieces = tuple(
            each if isinstance(each, bytes) else range(size)[slice(*each)]
            for each in frame.covered(part, ids).pieces
        )
        yield part.method, part.size, part.order, part.at % size, pieces


def told_by_checksum(one: MessageLayout, other: MessageLayout) -> bool:
    """Tell whether two messages never have the same bytes, as a checksum covers an unsent id."""
    if one.frame is not other.frame:
        return False
    pairs = zip(one.frame.ids, one.ids, other.ids, strict=True)
    differing = [part for part, here, there in pairs if here != there]
    return len(differing) == 1 and any(
        differing[0].name in checksum.of
        and CHECKSUMS[checksum.method].tells_apart(differing[0].size)
        for checksum in one.frame.checksums
    )


def _sizes(message: MessageLayout) -> range | list[int]:
    if isinstance(message.lengths, range):
        by, lengths = message.frame.uncounted, message.lengths
        return range(lengths.start + by, lengths.stop + by, lengths.step)
    return [length + message.frame.uncounted for length in message.lengths]


def _sent_ids(message: MessageLayout) -> tuple[int, ...]:
    return tuple(message.id_of(part) for part in message.frame.sent_ids)


def _marks(message: MessageLayout) -> dict[int, range]:
    """Return the values of the bytes that every frame of a message has, by offset."""
    end = message.least
    if message.largest != message.least:
        end -= message.frame.tail_size
    found: dict[int, range] = {}
    for placed in message.lay_out(message.counts[0]):
        if placed.end <= end:
            found |= enumerate(_values(message, placed), placed.at)
    return found


def _values(message: MessageLayout, placed: Placed) -> Iterator[range]:
    """Yield the values that the bytes of a slot can have, each by itself."""
    slot = placed.slot
    if isinstance(slot, Constant) and slot.role == "constant":
        yield from _exactly(slot.data)
    elif isinstance(slot, Number) and slot.role == "id":
        yield from _exactly(slot.write(message.id_of(slot)))
    elif isinstance(slot, Number) and slot.role == "length":
        # A frame that is too long for its length is another rule's concern.
        low, high = (min(message.lengths[end], slot.number_type.high) for end in (0, -1))
        yield from _between(slot, low, high)
    elif isinstance(slot, Text):
        yield from repeat(_ASCII, placed.size)
    elif isinstance(slot, Number) and _is_bounded(slot):
        yield from _between(slot, slot.low, slot.high)
    else:
        yield from repeat(_ANY, placed.size)


def _is_bounded(slot: Number) -> bool:
    # Of signed numbers, those of one sign are in order.
    return slot.is_field and not slot.is_float and (slot.low >= 0 or slot.high < 0)


def _exactly(data: bytes) -> Iterator[range]:
    return (range(byte, byte + 1) for byte in data)


def _between(number: Number, low: int, high: int) -> Iterator[range]:
    """Yield the values of each byte of a number from `low` to `high`."""
    found, same = [], True
    signed = number.number_type.low < 0
    ends = (each.to_bytes(number.size, "big", signed=signed) for each in (low, high))
    for one, other in zip(*ends, strict=True):
        found.append(range(one, other + 1) if same else _ANY)
        same = same and one == other
    return iter(found if number.order == "big" else found[::-1])


def _constants(slots: Iterable[Slot]) -> dict[int, range]:
    found: dict[int, range] = {}
    for slot in slots:
        if isinstance(slot, Constant) and slot.role == "constant":
            found |= enumerate(_exactly(slot.data), slot.at)
    return found


def _differ(one: dict[int, range], other: dict[int, range]) -> bool:
    """Tell whether a byte has no value in common."""
    return any(
        max(values.start, other[at].start) >= min(values.stop, other[at].stop)
        for at, values in one.items()
        if at in other
    )
