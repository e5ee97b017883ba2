"""What follows from a spec: where each field stands, how long a frame may be, how long it takes.

Derived once, and read by the checks, the reference codec and every target; none of them computes an
offset or a length of its own. `derive` needs a spec that the rules about its structure have passed.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.language.formula import Formula
from framegen.language.spec import ConstantPart, GroupField, IdPart, LengthPart
from framegen.language.wiretypes import WIRE_TYPES, WireType

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import FramePart, Limits, Link, Message, NumberField, Spec
    from framegen.language.values import Direction


@dataclass(frozen=True)
class FrameLayout:
    """The envelope of every frame: its parts from first byte to body.

    `uncounted` is how many bytes of a frame its length does not count.
    """

    header: bytes
    length: WireType
    length_name: str
    length_at: int
    id: WireType
    id_name: str
    id_at: int
    body_at: int
    uncounted: int

    @property
    def counted(self) -> int:
        """How much the length counts besides the body."""
        return self.body_at - self.uncounted

    @property
    def legal_ids(self) -> range:
        """The codes that a message can have."""
        return range(self.id.low, self.id.high + 1)


@dataclass(frozen=True)
class WireField:
    """A number in its place: `offset` counts from the first byte of the frame or the element."""

    name: str
    offset: int
    wire: WireType
    field: NumberField

    @property
    def low(self) -> int:
        """The lowest value allowed."""
        return self.wire.low if self.field.range is None else self.field.range.low

    @property
    def high(self) -> int:
        """The highest value allowed."""
        declared = self.field.range
        return self.wire.high if declared is None or declared.high is None else declared.high

    @property
    def narrowed(self) -> bool:
        """Whether fewer values are allowed than the type holds."""
        return (self.low, self.high) != (self.wire.low, self.wire.high)


@dataclass(frozen=True)
class Repeat:
    """The list at the end of a message: its elements, and the count that goes before it.

    `element` is the class of an element with several fields, or None in a list of bare numbers.
    """

    name: str
    offset: int
    element: str | None
    fields: tuple[WireField, ...]
    counter: WireField
    low: int
    high: int
    field: GroupField | NumberField

    @property
    def size(self) -> int:
        """Bytes of one element."""
        return sum(field.wire.size for field in self.fields)


@dataclass(frozen=True)
class MessageLayout:
    """One message in its frame. `numbers` are the fields before the list, the count among them."""

    name: str
    message: Message
    frame: FrameLayout
    link: Link
    numbers: tuple[WireField, ...]
    repeat: Repeat | None

    @property
    def id(self) -> int:
        """The code of the message."""
        return self.message.id

    @property
    def direction(self) -> Direction:
        """Who sends it to whom."""
        return self.message.direction

    @cached_property
    def formula(self) -> Formula:
        """The length as it follows from the fields."""
        constant = self.frame.counted + sum(field.wire.size for field in self.numbers)
        if self.repeat is None:
            return Formula(constant)
        return Formula(constant, self.repeat.size, self.repeat.counter.name)

    @property
    def counts(self) -> range:
        """How many elements a frame may have; 0 alone where the message has no list."""
        return range(1) if self.repeat is None else range(self.repeat.low, self.repeat.high + 1)

    @cached_property
    def lengths(self) -> range:
        """Every value that the length of a legal frame can have."""
        lowest, highest = self.formula.at(self.counts[0]), self.formula.at(self.counts[-1])
        return range(lowest, highest + 1, self.formula.factor or 1)

    @property
    def largest(self) -> int:
        """Bytes of the largest legal frame."""
        return self.lengths[-1] + self.frame.uncounted

    @property
    def arguments(self) -> tuple[WireField | Repeat, ...]:
        """What a user gives: every field but the count."""
        given: list[WireField | Repeat] = [
            field for field in self.numbers if not self.counts_with(field)
        ]
        return tuple(given if self.repeat is None else [*given, self.repeat])

    @property
    def limited(self) -> dict[str, Limits]:
        """The limits of what a client sends, by path: `targets.position` for one in an element."""
        found = {field.name: field.field.limits for field in self.numbers}
        if self.repeat is not None:
            for field in self.repeat.fields:
                inner = f".{field.name}" if self.repeat.element is not None else ""
                found[f"{self.repeat.name}{inner}"] = field.field.limits
        return {path: limits for path, limits in found.items() if limits is not None}

    def counts_with(self, field: WireField) -> bool:
        """Whether `field` is the count of the list."""
        return self.repeat is not None and field is self.repeat.counter

    def wire_seconds(self, size: int) -> float:
        """How long `size` bytes are on the line."""
        return size * self.link.bits_per_byte / self.link.baud

    def fields_of(self, count: int) -> Iterator[tuple[str, int, WireField]]:
        """Each number of a frame with `count` elements: its path, its offset and its field."""
        for field in self.numbers:
            yield field.name, field.offset, field
        if self.repeat is None:
            return
        for index in range(count):
            start = self.repeat.offset + index * self.repeat.size
            for field in self.repeat.fields:
                path = f"{self.repeat.name}[{index}]"
                yield (
                    path if self.repeat.element is None else f"{path}.{field.name}",
                    start + field.offset,
                    field,
                )


def part_size(part: FramePart) -> int:
    """Bytes of a part of the frame; 0 for the body, whose size varies."""
    if isinstance(part, ConstantPart):
        return len(part.bytes_)
    type_ = getattr(part, "type", None)
    return 0 if type_ is None else WIRE_TYPES[type_].size


def derive_frame(spec: Spec) -> FrameLayout:
    """Work out the envelope of every frame. Needs a spec that keeps the rule frame-parts."""
    header = b""
    length_at = id_at = at = 0
    length_name = id_name = ""
    length: LengthPart | None = None
    id_: IdPart | None = None
    for name, part in spec.frame.items():
        if isinstance(part, ConstantPart):
            header += part.bytes_
        elif isinstance(part, LengthPart):
            length, length_name, length_at = part, name, at
        elif isinstance(part, IdPart):
            id_, id_name, id_at = part, name, at
        at += part_size(part)
    if length is None or id_ is None:
        raise AssertionError("the rule frame-parts sees to both")
    uncounted = sum(
        part_size(part) for name, part in spec.frame.items() if name not in length.counts
    )
    return FrameLayout(
        header,
        WIRE_TYPES[length.type],
        length_name,
        length_at,
        WIRE_TYPES[id_.type],
        id_name,
        id_at,
        at,
        uncounted,
    )


def derive_message(spec: Spec, frame: FrameLayout, name: str) -> MessageLayout:
    """Work out where the fields of a message stand."""
    message = spec.messages[name]
    numbers: list[WireField] = []
    repeat: Repeat | None = None
    at = frame.body_at
    for field_name, field in message.fields.items():
        if field.counted_by is None and not isinstance(field, GroupField):
            numbers.append(WireField(field_name, at, WIRE_TYPES[field.type], field))
            at += numbers[-1].wire.size
            continue
        counter = next(number for number in numbers if number.name == field.counted_by)
        fields = _element(field_name, field)
        size = sum(each.wire.size for each in fields)
        low, high = _count_bounds(frame, field, counter, at - frame.uncounted, size)
        element = field.element if isinstance(field, GroupField) else None
        repeat = Repeat(field_name, at, element, fields, counter, low, high, field)
    return MessageLayout(name, message, frame, spec.link, tuple(numbers), repeat)


def _element(name: str, field: GroupField | NumberField) -> tuple[WireField, ...]:
    if not isinstance(field, GroupField):
        return (WireField(name, 0, WIRE_TYPES[field.type], field),)
    placed: list[WireField] = []
    at = 0
    for inner_name, inner in field.fields.items():
        placed.append(WireField(inner_name, at, WIRE_TYPES[inner.type], inner))
        at += placed[-1].wire.size
    return tuple(placed)


def _count_bounds(
    frame: FrameLayout,
    field: GroupField | NumberField,
    counter: WireField,
    constant: int,
    size: int,
) -> tuple[int, int]:
    """Find the fewest and the most elements: as declared, or as length and count have room for."""
    room = min((frame.length.high - constant) // size, counter.high)
    declared = field.count
    if declared is None:
        return 0, room
    return declared.low, room if declared.high is None else declared.high
