"""The layout of a message: its slots, how long its frame may be, and its time on the wire.

Derived once, and read by the checks, the reference codec and every target; none of them computes an
offset or a length of its own. `derive_message` needs a spec that the structure rules have passed.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.language.formula import Formula
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import ListField
from framegen.model.slots import Body, Constant, Items, Number, lay_out

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.language.spec import Limits, Link, Message, NumberField, Spec
    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.slots import MessageSlot, NumberRole, Placed

# What stands where is not remembered of frames with more elements: they would fill the memory.
_KEPT = 0x100


@dataclass(frozen=True)
class MessageLayout:
    """One message: the slots of its frame, from the first byte to the last."""

    name: str
    message: Message
    frame: Envelope
    link: Link
    slots: tuple[MessageSlot, ...]

    @property
    def id(self) -> int:
        """The id of the message."""
        return self.message.id

    @property
    def direction(self) -> Direction:
        """The sender and the receiver."""
        return self.message.direction

    @cached_property
    def fields(self) -> tuple[Number | Items, ...]:
        """The slots of the message between head and tail: counts, numbers and the list."""
        return tuple(
            slot
            for slot in self.slots
            if isinstance(slot, Items) or (isinstance(slot, Number) and slot.is_field)
        )

    @cached_property
    def items(self) -> Items | None:
        """The list, where the message has one."""
        return next((slot for slot in self.slots if isinstance(slot, Items)), None)

    @cached_property
    def arguments(self) -> tuple[Number | Items, ...]:
        """The fields that a user gives: all but the count."""
        return tuple(slot for slot in self.fields if isinstance(slot, Items) or slot.given)

    @property
    def limited(self) -> dict[str, Limits]:
        """The limits of what a client sends, by path: `targets.position` in an element."""
        return {
            path: field.field.limits
            for path, field in self.numbers_by_path.items()
            if field.field.limits is not None
        }

    @cached_property
    def numbers_by_path(self) -> dict[str, Number]:
        """Every number of a field or of an element: `time_ms`, `targets.position`."""
        found: dict[str, Number] = {}
        for slot in self.fields:
            if isinstance(slot, Number):
                found[slot.name] = slot
                continue
            for field in slot.fields:
                inner = "" if slot.element is None else f".{field.name}"
                found[f"{slot.name}{inner}"] = field
        return found

    # Its size: `base + step * n`, solved both ways.

    @cached_property
    def formula(self) -> Formula:
        """The length rule that follows from the slots."""
        fixed = sum(slot.size for slot in self.slots if isinstance(slot, Constant | Number))
        constant = fixed - self.frame.uncounted
        if self.items is None:
            return Formula(constant)
        return Formula(constant, self.items.size, self.items.counter.name)

    @property
    def counts(self) -> range:
        """The legal numbers of elements; 0 alone where the message has no list."""
        return range(1) if self.items is None else range(self.items.low, self.items.high + 1)

    @cached_property
    def lengths(self) -> range:
        """The legal values of the length."""
        lowest, highest = self.formula.at(self.counts[0]), self.formula.at(self.counts[-1])
        return range(lowest, highest + 1, self.formula.factor or 1)

    def size_at(self, count: int) -> int:
        """Return the size of a frame with `count` elements in bytes."""
        return self.formula.at(count) + self.frame.uncounted

    def count_at(self, length: int) -> int:
        """Return the count of a frame with this legal length. Raises ValueError for others."""
        return self.counts[self.lengths.index(length)]

    def count_of(self, frame: bytes) -> int:
        """Return the number of elements of a legal frame."""
        return self.count_at(self.frame.length.read_in(frame))

    @property
    def largest(self) -> int:
        """The size of the largest legal frame in bytes."""
        return self.size_at(self.counts[-1])

    def lay_out(self, count: int) -> Iterable[Placed]:
        """Place the slots of a frame with `count` elements, from its first byte on."""
        if count > _KEPT:
            return lay_out(self.slots, self.size_at(count), count)
        if count not in self._laid_out:
            self._laid_out[count] = tuple(lay_out(self.slots, self.size_at(count), count))
        return self._laid_out[count]

    @cached_property
    def _laid_out(self) -> dict[int, tuple[Placed, ...]]:
        """The placed slots by count, computed once because they are needed often."""
        return {}

    def wire_seconds(self, size: int) -> float:
        """Return how long `size` bytes take on the line."""
        return size * self.link.bits_per_byte / self.link.baud


def derive_message(spec: Spec, frame: Envelope, name: str) -> MessageLayout:
    """Derive the slots of a message: those of the envelope, with its fields for a body."""
    message = spec.messages[name]
    slots: list[MessageSlot] = []
    for slot in frame.slots:
        if isinstance(slot, Body):
            slots.extend(_fields(spec, frame, message))
        else:
            slots.append(slot)
    return MessageLayout(name, message, frame, spec.link, tuple(slots))


def _fields(spec: Spec, frame: Envelope, message: Message) -> Iterator[MessageSlot]:
    counters = {field.counted_by for field in message.fields.values()}
    numbers: dict[str, Number] = {}
    at = frame.body_at
    behind = sum(slot.size for slot in frame.tail)
    for name, field in message.fields.items():
        if field.counted_by is None and not isinstance(field, ListField):
            role: NumberRole = "count" if name in counters else "field"
            number_type = NUMBER_TYPES[field.type]
            numbers[name] = Number(name, role, at, number_type, spec.byte_order, field)
            yield numbers[name]
            at += number_type.size
            continue
        element = field.element if isinstance(field, ListField) else None
        fields = tuple(_element(spec, name, field))
        counter = numbers[str(field.counted_by)]
        fixed = at + behind - frame.uncounted
        low, high = _count_bounds(frame, field, counter, fixed, sum(each.size for each in fields))
        yield Items(name, at, element, fields, counter, low, high, field)


def _element(spec: Spec, name: str, field: ListField | NumberField) -> Iterator[Number]:
    at = 0
    inner = field.fields if isinstance(field, ListField) else {name: field}
    for each, number in inner.items():
        yield Number(each, "field", at, NUMBER_TYPES[number.type], spec.byte_order, number)
        at += NUMBER_TYPES[number.type].size


def _count_bounds(
    frame: Envelope,
    field: ListField | NumberField,
    counter: Number,
    constant: int,
    size: int,
) -> tuple[int, int]:
    """Return the fewest and the most elements, as declared or as length and count allow."""
    room = min((frame.length.high - constant) // size, counter.high)
    declared = field.count
    if declared is None:
        return 0, room
    return declared.low, room if declared.high is None else declared.high
