"""The layout of a message: its slots, how long its frame may be, and its time on the wire.

Derived once, and read by the checks, the reference codec and every target; none of them computes an
offset or a length of its own. `derive_message` needs a spec that the structure rules have passed.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.language.formula import Formula, Sizes
from framegen.language.number_types import ALL_TYPES
from framegen.language.spec import ListField
from framegen.model.slots import Body, Constant, Items, Number, Packed, Text, lay_out

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from framegen.language.formula import LengthRule
    from framegen.language.spec import Limits, Link, Message, NumberField, Spec
    from framegen.language.values import Direction
    from framegen.model.covered import Covered
    from framegen.model.envelope import Envelope
    from framegen.model.slots import Field, MessageSlot, NumberRole, Placed

# What stands where is not remembered of frames with more elements: they would fill the memory.
_KEPT = 0x100
# The size of the largest frame that there may be, whatever its length can say.
LONGEST = 0xFFFF


@dataclass(frozen=True, repr=False)
class MessageLayout:
    """One message: the slots of its frame, from the first byte to the last."""

    name: str
    message: Message
    frame: Envelope
    link: Link
    slots: tuple[MessageSlot, ...]

    def __repr__(self) -> str:
        return f"<MessageLayout of {self.name}>"

    @cached_property
    def ids(self) -> tuple[int, ...]:
        """The ids of the message, one for each id part of its envelope."""
        said, parts = self.message.id, self.frame.ids
        if said is None:
            return ()
        if said.one is not None:
            return (said.one,)
        by_part = dict(said.by_part)
        return tuple(by_part[part.name] for part in parts)

    @property
    def id(self) -> int:
        """The id of the message by which a frame tells it, the last of several."""
        return self.id_of(self.frame.id)

    def id_of(self, part: Number) -> int:
        """Return the id of the message that a part of its envelope holds."""
        return self.ids[self.frame.ids.index(part)]

    @property
    def direction(self) -> Direction:
        """The sender and the receiver."""
        return self.message.direction

    @cached_property
    def body(self) -> tuple[MessageSlot, ...]:
        """The slots of the message between head and tail, constants among them."""
        return self.slots[len(self.frame.head) : len(self.slots) - len(self.frame.tail)]

    @cached_property
    def fields(self) -> tuple[Field, ...]:
        """The slots of the message between head and tail: counts, numbers and lists."""
        return tuple(
            slot
            for slot in self.slots
            if isinstance(slot, Items | Packed | Text)
            or (isinstance(slot, Number) and slot.is_field)
        )

    @cached_property
    def items(self) -> Items | None:
        """The list of a size that varies, where the message has one: its last field."""
        lists = (slot for slot in self.slots if isinstance(slot, Items))
        return next((slot for slot in lists if not slot.is_fixed), None)

    @cached_property
    def optional(self) -> tuple[Number, ...]:
        """The fields that may be absent, each with those behind it."""
        return tuple(slot for slot in self.slots if isinstance(slot, Number) and slot.optional)

    @cached_property
    def arguments(self) -> tuple[Field, ...]:
        """What a user gives: the address, and all fields but the count; a running number last."""
        fields = tuple(slot for slot in self.fields if not isinstance(slot, Number) or slot.given)
        address, counter = self.frame.address, self.frame.counter
        front = () if address is None else (address,)
        return (*front, *fields) if counter is None else (*front, *fields, counter)

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
            for field in slot.fields if isinstance(slot, Items) else ():
                inner = "" if isinstance(slot, Items) and slot.element is None else f".{field.name}"
                if isinstance(field, Number):
                    found[f"{slot.name}{inner}"] = field
        return found

    def covered(self, checksum: Number) -> Covered:
        """Return what a checksum is worked out from."""
        return self.frame.covered(checksum, self.ids_by_part)

    @cached_property
    def ids_by_part(self) -> dict[str, int]:
        """The ids of the message, by the name of their part."""
        return dict(zip((part.name for part in self.frame.ids), self.ids, strict=True))

    def sealed(self, frame: bytes) -> bytes:
        """Return a whole frame of the message with the checksums that it should have."""
        return self.frame.sealed(frame, self.ids_by_part)

    def checksum(self, checksum: Number, frame: bytes) -> bytes:
        """Return the checksum that a whole frame of the message should have, as bytes."""
        return self.covered(checksum).checksum(checksum, frame)

    # Its size, by a count: that of the elements of its list, or the number of its size among those
    # that it may have, from 0. With a list it is `base + step * count`, solved both ways.

    @cached_property
    def formula(self) -> LengthRule:
        """The length rule that follows from the slots."""
        if self.optional:
            possible, declared = self.possible, self.message.length
            listed = declared.sizes if isinstance(declared, Sizes) else possible
            return Sizes(tuple(size for size in possible if size in listed) or possible)
        if self.items is None:
            return Formula(self._constant)
        return Formula(self._constant, self.items.size, self.items.variable)

    @cached_property
    def possible(self) -> tuple[int, ...]:
        """The length with none of the optional fields, with the first, and so on to all."""
        there = (self.optional[:number] for number in range(len(self.optional) + 1))
        return tuple(self._constant + sum(slot.size for slot in each) for each in there)

    @cached_property
    def _constant(self) -> int:
        """The length without the list, and without all that may be absent."""
        absent = sum(slot.size for slot in self.optional)
        sizes = (slot.size for slot in self.slots if slot is not self.items)
        constant = sum(sizes) - absent - self.frame.uncounted
        for slot in self.slots:
            if isinstance(slot, Items) and slot is not self.items:
                constant += (slot.low - 1) * slot.size
        return constant

    @property
    def counts(self) -> range:
        """The legal counts; 0 alone where the size of the message is fixed."""
        if self.items is not None:
            return range(self.items.low, self.items.high + 1)
        return range(len(self.formula.sizes) if isinstance(self.formula, Sizes) else 1)

    @cached_property
    def lengths(self) -> range | tuple[int, ...]:
        """The legal values of the length, by count."""
        if isinstance(self.formula, Sizes):
            return self.formula.sizes
        lowest, highest = self.formula.at(self.counts[0]), self.formula.at(self.counts[-1])
        return range(lowest, highest + 1, self.formula.factor or 1)

    def size_at(self, count: int) -> int:
        """Return the size of a frame with this count in bytes."""
        return self.formula.at(count) + self.frame.uncounted

    def count_at(self, length: int) -> int:
        """Return the count of a frame with this legal length. Raises ValueError for others."""
        return self.counts[self.lengths.index(length)]

    def count_of(self, frame: bytes) -> int:
        """Return the count of a legal frame."""
        return self.count_at(len(frame) - self.frame.uncounted)

    @property
    def least(self) -> int:
        """The size of the smallest legal frame in bytes."""
        return self.size_at(self.counts[0])

    @property
    def largest(self) -> int:
        """The size of the largest legal frame in bytes."""
        return self.size_at(self.counts[-1])

    def lay_out(self, count: int) -> Iterable[Placed]:
        """Place the slots of a frame with this count, from its first byte on."""
        if count > _KEPT:
            return lay_out(self.there(count), self.size_at(count), count)
        if count not in self._laid_out:
            placed = lay_out(self.there(count), self.size_at(count), count)
            self._laid_out[count] = tuple(placed)
        return self._laid_out[count]

    def there(self, count: int) -> Iterable[MessageSlot]:
        """Return the slots that a frame with this count has."""
        if not self.optional:
            return self.slots
        end = self.size_at(count) - self.frame.tail_size
        return [slot for slot in self.slots if not 0 <= end <= slot.at]

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
    roles = _roles(message)
    numbers: dict[str, Number] = {}
    at = frame.body_at
    slot: MessageSlot
    for name, field in message.fields.items():
        if isinstance(field, ListField) or is_list(field):
            slot = _list(spec, frame, name, field, at, numbers)
            at += slot.size * slot.low if isinstance(slot, Items) else slot.size
        else:
            slot = _single(spec, name, field, roles.get(name, "field"), at)
            if isinstance(slot, Number):
                numbers[name] = slot
            at += slot.size
        yield slot


def _single(
    spec: Spec, name: str, field: NumberField, role: NumberRole, at: int
) -> Number | Text | Constant:
    """Return a field or a part of an element that is no list: a number, a text or a constant."""
    number_type = ALL_TYPES[field.type]
    number = Number(name, role, at, number_type, field.byte_order or spec.byte_order, field)
    times = 1 if field.count is None else field.count.low
    if field.always is not None:
        return Constant(name, at, number.write(field.always) * times, field.about, field=field)
    if field.reserved is not None:
        data = number.write(field.reserved) * times
        return Constant(name, at, data, field.about, "reserved", field)
    if field.text is not None:
        return Text(name, at, times, field.text, field)
    return number


def is_list(field: ListField | NumberField) -> bool:
    """Tell whether a field is a list, of elements or of bare numbers."""
    if isinstance(field, ListField):
        return True
    if is_varying(field):
        return True
    return field.count is not None and field.text is None and not is_constant(field)


def is_varying(field: ListField | NumberField) -> bool:
    """Tell whether a field is a list whose size varies."""
    return field.counted_by is not None or field.sized_by is not None


def is_constant(field: ListField | NumberField) -> bool:
    """Tell whether a field never changes, or has no meaning: nobody gives it."""
    if isinstance(field, ListField):
        return False
    return field.always is not None or field.reserved is not None


def _roles(message: Message) -> dict[str, NumberRole]:
    """Return the roles of those fields that say how long a list is, by name."""
    roles: dict[str, NumberRole] = {}
    for field in message.fields.values():
        if field.counted_by is not None:
            roles[field.counted_by] = "count"
        if field.sized_by is not None:
            roles[field.sized_by] = "size"
    return roles


def _list(
    spec: Spec,
    frame: Envelope,
    name: str,
    field: ListField | NumberField,
    at: int,
    numbers: Mapping[str, Number],
) -> Items | Packed:
    named = (field.counted_by, field.sized_by)
    counters = tuple(number for name, number in numbers.items() if name in named)
    if not isinstance(field, ListField):
        number_type = ALL_TYPES[field.type]
        if number_type.is_packed:
            count = 0 if field.count is None else field.count.low
            order = field.byte_order or spec.byte_order
            return Packed(name, at, number_type, count, order, field)
    element = field.element if isinstance(field, ListField) else None
    slots = tuple(_element(spec, name, field))
    size = sum(each.size for each in slots)
    low, high = _count_bounds(frame, field, counters, at + frame.tail_size, size)
    return Items(name, at, element, slots, counters, low, high, field)


def _element(
    spec: Spec, name: str, field: ListField | NumberField
) -> Iterator[Number | Text | Constant]:
    if not isinstance(field, ListField):
        order = field.byte_order or spec.byte_order
        yield Number(name, "field", 0, ALL_TYPES[field.type], order, field)
        return
    at = 0
    for each, number in field.fields.items():
        slot = _single(spec, each, number, "field", at)
        yield slot
        at += slot.size


def _count_bounds(
    frame: Envelope,
    field: ListField | NumberField,
    counters: Sequence[Number],
    fixed: int,
    size: int,
) -> tuple[int, int]:
    """Return the fewest and the most elements, as declared or as length and count allow.

    A list without a counter has the number declared, unless the length of the frame says more.
    """
    declared = field.count
    if not counters and field.sized_by is None:
        return (0, 0) if declared is None else (declared.low, declared.low)
    longest = LONGEST if frame.longest is None else frame.longest
    room = (longest - fixed) // size
    for counter in counters:
        room = min(room, counter.high // (size if counter.role == "size" else 1))
    if declared is None:
        return 0, room
    return declared.low, room if declared.high is None else declared.high
