"""Slots: a frame is an ordered list of them, each some bytes that belong together.

The envelope and the fields are the same kind of thing: a slot has a name, a role, and a place,
which counts from the first byte of the frame or, below zero, from its end. Code that needs to know
what stands where walks the slots of a message with `lay_out`: a new kind of part is a role here, a
case in the codec, and a case in each target that shows it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Literal, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.language.number_types import NumberType
    from framegen.language.spec import ListField, NumberField

ByteOrder: TypeAlias = Literal["little", "big"]

# What a number is there for. All but `field` and `address` follow from the rest of the frame.
NumberRole: TypeAlias = Literal["length", "id", "address", "checksum", "count", "field"]


@dataclass(frozen=True)
class Constant:
    """Bytes that never change."""

    role: ClassVar = "constant"

    name: str
    at: int
    data: bytes
    about: str = ""

    @property
    def size(self) -> int:
        """The size in bytes."""
        return len(self.data)


@dataclass(frozen=True)
class Number:
    """A number of the envelope, of a field, or of an element, whose place counts from the element.

    `field` is what the spec says of it. `of` names the slots that it is computed from: those that a
    length counts, or those that a checksum covers.
    """

    name: str
    role: NumberRole
    at: int
    number_type: NumberType
    order: ByteOrder
    field: NumberField
    of: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """The size in bytes."""
        return self.number_type.size

    @cached_property
    def low(self) -> int:
        """The lowest value allowed."""
        return self.number_type.low if self.field.range is None else self.field.range.low

    @cached_property
    def high(self) -> int:
        """The highest value allowed."""
        declared = self.field.range
        return self.number_type.high if declared is None or declared.high is None else declared.high

    @property
    def narrowed(self) -> bool:
        """Whether fewer values are allowed than the type has."""
        return (self.low, self.high) != (self.number_type.low, self.number_type.high)

    @property
    def is_field(self) -> bool:
        """Whether it belongs to the message; all others belong to the envelope."""
        return self.role in ("count", "field")

    @property
    def given(self) -> bool:
        """Whether a user gives it; what follows from the rest of the frame is never an argument."""
        return self.role in ("field", "address")

    def read(self, data: bytes) -> int:
        """Read the number from its bytes."""
        return int.from_bytes(data, self.order, signed=self.number_type.low < 0)

    def read_in(self, frame: bytes) -> int:
        """Read the number from `frame`, which holds all of it."""
        at = _from_front(self.at, len(frame))
        return self.read(frame[at : at + self.size])

    def is_in(self, data: bytes) -> bool:
        """Tell whether `data` holds all of it; never, if it is placed from the end."""
        return 0 <= self.at <= len(data) - self.size

    def write(self, value: int) -> bytes:
        """Write `value` as bytes. Raises OverflowError where it does not fit."""
        return value.to_bytes(self.size, self.order, signed=self.number_type.low < 0)


@dataclass(frozen=True)
class Items:
    """A list: as many elements as its counter says, each with the same fields.

    `element` is the name of an element with several fields, None for bare numbers.
    """

    role: ClassVar = "list"

    name: str
    at: int
    element: str | None
    fields: tuple[Number, ...]
    counter: Number
    low: int
    high: int
    field: ListField | NumberField

    @cached_property
    def size(self) -> int:
        """The size of an element in bytes."""
        return sum(field.size for field in self.fields)

    def path(self, index: int | str, field: Number) -> str:
        """Return the path of a number in an element: `targets[0].position`, or `ids[0]`."""
        inner = "" if self.element is None else f".{field.name}"
        return f"{self.name}[{index}]{inner}"


@dataclass(frozen=True)
class Body:
    """The place of a message's fields in an envelope."""

    role: ClassVar = "body"

    name: str
    at: int
    about: str = ""


# Those of a message, whose fields stand where its envelope has the body.
MessageSlot: TypeAlias = Constant | Number | Items
Slot: TypeAlias = MessageSlot | Body


@dataclass(frozen=True, slots=True)
class Placed:
    """A slot in a frame of known size, with its path and its place."""

    path: str
    at: int
    size: int
    slot: Constant | Number | Body

    @property
    def end(self) -> int:
        """The offset behind the last byte."""
        return self.at + self.size

    def of(self, frame: bytes) -> bytes:
        """Return its bytes, as far as `frame` holds them."""
        return frame[self.at : self.end]


def lay_out(slots: Iterable[Slot], size: int, count: int = 0) -> Iterator[Placed]:
    """Place the slots of a frame of `size` bytes with `count` elements, in order."""
    slots = list(slots)
    for slot in slots:
        at = _from_front(slot.at, size)
        match slot:
            case Items():
                for index in range(count):
                    start = at + index * slot.size
                    for field in slot.fields:
                        path = slot.path(index, field)
                        yield Placed(path, start + field.at, field.size, field)
            case Body():
                fixed = sum(each.size for each in slots if isinstance(each, Constant | Number))
                yield Placed(slot.name, at, size - fixed, slot)
            case _:
                yield Placed(slot.name, at, slot.size, slot)


def _from_front(at: int, size: int) -> int:
    """Convert a place that may count from the end of a frame into an offset."""
    return at if at >= 0 else size + at
