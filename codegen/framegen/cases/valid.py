"""Frames with their values: the examples of a spec, and the ends of its ranges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from framegen.cases.lengthened import lengthened
from framegen.model.codec import encode
from framegen.model.slots import Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Field

# So many items need two bytes of a count, and of a length: more would show nothing else.
_ENOUGH = 0x100
# Nor would a frame of more bytes than this.
_LARGE = 0x1000
# No decimal fraction is exact in binary, and every one is rounded otherwise to fewer bits.
_FRACTION = -0.1

_End: TypeAlias = Literal["low", "high", "fraction"]


@dataclass(frozen=True)
class ValidFrame:
    """A frame, and the values that it carries."""

    title: str
    message: MessageLayout
    values: Mapping[str, Any]

    @property
    def data(self) -> bytes:
        """The bytes of the frame."""
        return encode(self.message, self.values)


def valid_frames(model: Model) -> Iterator[ValidFrame]:
    """Yield the frames of every message, then those that begin as frames of shorter messages do."""
    for message in model.messages.values():
        yield from frames_of(message)
    for each in lengthened(model):
        yield ValidFrame(f"its beginning is a whole {each.short.name}", each.long, each.values)


def frames_of(message: MessageLayout) -> Iterator[ValidFrame]:
    """Yield the examples of one message, then the ends of its ranges; at least one frame."""
    counter = message.frame.counter
    usual = {} if counter is None else {counter.name: 0}
    for example in message.message.examples:
        values = usual | example.values
        given = {slot.name: values[slot.name] for slot in message.arguments}
        yield ValidFrame(example.title, message, given)
    for title, values in range_ends(message):
        yield ValidFrame(title, message, values)
    if not message.arguments and not message.message.examples:
        yield ValidFrame("the only frame", message, {})


def range_ends(message: MessageLayout) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield every field at its lowest, then at its highest; a list short, then long.

    Then what is in neither: addresses with a name outside of the range, some of the optional
    fields, and fractions.
    """
    if not message.arguments:
        return
    fewest, most = message.counts[0], message.counts[-1]
    many = _many(message)
    ends: list[tuple[_End, str, int]] = [("low", "lowest", fewest), ("high", "highest", many)]
    for end, word, count in ends:
        shortened = "" if count in (fewest, most) else f", {count} items of up to {most}"
        yield f"every value at its {word}{shortened}", values_at(message, end, count)
    for address in _named_addresses(message):
        values = values_at(message, "low", fewest)
        yield f"{address.name} of {address.value}", {**values, address.name: address.value}
    if message.optional:
        for count in message.counts[1:-1]:
            there = [slot.name for slot in message.there(count) if slot in message.optional]
            yield f"as far as {there[-1]}", values_at(message, "high", count)
    if any(slot.is_float for slot in message.numbers_by_path.values()):
        yield "every fraction rounded", values_at(message, "fraction", many)


def values_at(message: MessageLayout, end: _End, count: int) -> dict[str, Any]:
    """Return every argument at one end of its range, for a frame with this count.

    A list of a varying size has so many elements; optional fields that such a frame has not are
    None.
    """
    there = {slot.name for slot in message.there(count)}
    return {
        slot.name: _value(slot, end, count) if slot.name in there else None
        for slot in message.arguments
    }


def _many(message: MessageLayout) -> int:
    """Return a count of many elements, of frames that are not too large to be looked at."""
    counts = message.counts
    step = message.formula.factor
    room = (_LARGE - message.least) // step if step else counts[-1]
    return max(counts[0], min(counts[-1], _ENOUGH, counts[0] + room))


@dataclass(frozen=True, slots=True)
class _Address:
    name: str
    value: int


def _named_addresses(message: MessageLayout) -> list[_Address]:
    """Return the addresses that have a name, as far as they lie outside of the range."""
    part = message.frame.address
    if part is None:
        return []
    beyond = sorted(value for value in part.named if not part.low <= value <= part.high)
    return [_Address(part.name, value) for value in beyond]


def _value(slot: Field, end: _End, count: int) -> Any:
    match slot:
        case Items():
            items = [item_at(slot, end) for _ in range(slot.low if slot.is_fixed else count)]
            return items if slot.text is None else "".join(map(chr, items))
        case Packed():
            return [slot.low if end == "low" else slot.high] * slot.count
        case _:
            return _end(slot, end)


def item_at(items: Items, end: _End) -> Any:
    """Return an element with every number at one end of its range."""
    if items.element is None:
        return _end(items.fields[0], end)
    return {field.name: _end(field, end) for field in items.fields}


def _end(slot: Number | Text, end: _End) -> Any:
    if isinstance(slot, Text):
        return "" if end == "low" else "~" * slot.size
    bound = slot.low if end == "low" else slot.high
    if not slot.is_float:
        return bound
    return slot.value(slot.write(_FRACTION)) if end == "fraction" else float(bound)
