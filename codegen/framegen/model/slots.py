"""Slots: a frame is an ordered list of them, each some bytes that belong together.

The envelope and the fields are the same kind of thing: a slot has a name, a role, and a place,
which counts from the first byte of the frame or, below zero, from its end. Code that needs to know
what stands where walks the slots of a message with `lay_out`: a new kind of part is a role here, a
case in the codec, and a case in each target that shows it.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Literal, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from framegen.language.number_types import NumberType
    from framegen.language.spec import ListField, NumberField

ByteOrder: TypeAlias = Literal["little", "big"]

# Of ASCII.
_HIGHEST_CHARACTER = 0x7F

# What a number is there for. Only a `field`, an `address` and a `counter` are given by a user; a
# `count` and a `size` are the number of elements of a list, and that of its bytes.
NumberRole: TypeAlias = Literal[
    "length",
    "id",
    "address",
    "counter",
    "checksum",
    "count",
    "size",
    "field",
]


@dataclass(frozen=True)
class Constant:
    """Bytes that never change; those of the role `reserved` are not checked.

    `field` is what the spec says of those that belong to a message, or to an element.
    """

    name: str
    at: int
    data: bytes
    about: str = ""
    role: Literal["constant", "reserved"] = "constant"
    field: NumberField | None = None

    @property
    def size(self) -> int:
        """The size in bytes."""
        return len(self.data)


@dataclass(frozen=True)
class Number:
    """A number of the envelope, of a field, or of an element, whose place counts from the element.

    `field` is what the spec says of it. `of` names the slots that it is computed from: those that a
    length counts, or those that a checksum covers by its `method`. `silent` are addresses that
    nobody answers.
    """

    name: str
    role: NumberRole
    at: int
    number_type: NumberType
    order: ByteOrder
    field: NumberField
    of: tuple[str, ...] = ()
    method: str = ""
    silent: frozenset[int] = frozenset()

    @cached_property
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
        highest = _HIGHEST_CHARACTER if self.field.text else self.number_type.high
        return highest if declared is None or declared.high is None else declared.high

    @property
    def narrowed(self) -> bool:
        """Whether fewer values are allowed than the type has."""
        return (self.low, self.high) != (self.number_type.low, self.number_type.high)

    @cached_property
    def is_float(self) -> bool:
        """Whether it is a floating-point number; its range is that of its type, and more."""
        return self.number_type.is_float

    def holds(self, value: float) -> bool:
        """Tell whether a frame may hold this value; of an address, whether the spec allows it."""
        if self.is_float:
            return True
        return self.low <= value <= self.high or value in self.named

    @cached_property
    def named(self) -> frozenset[int]:
        """The addresses of a name, which may lie outside the range."""
        if self.role != "address":
            return frozenset()
        return frozenset(named.value for named in self.field.values.values())

    @property
    def is_field(self) -> bool:
        """Whether it belongs to the message; all others belong to the envelope."""
        return self.role in ("count", "size", "field")

    @property
    def given(self) -> bool:
        """Whether a user gives it; what follows from the rest of the frame is never an argument."""
        return self.role in ("field", "address", "counter")

    @property
    def counts(self) -> bool:
        """Whether it says how long a list is, in elements or in bytes."""
        return self.role in ("count", "size")

    @property
    def optional(self) -> bool:
        """Whether it may be absent."""
        return self.role == "field" and self.field.optional

    def read(self, data: bytes) -> int:
        """Read a whole number from its bytes."""
        return int.from_bytes(data, self.order, signed=self.number_type.low < 0)

    def value(self, data: bytes) -> float:
        """Return the value of its bytes, which is a whole number unless its type is none."""
        if self.is_float:
            (value,) = struct.unpack(self._layout, data)
            return float(value)
        return self.read(data)

    @cached_property
    def _layout(self) -> str:
        return ("<" if self.order == "little" else ">") + self.number_type.code

    def read_in(self, frame: bytes) -> int:
        """Read the number from `frame`, which holds all of it."""
        at = _from_front(self.at, len(frame))
        return self.read(frame[at : at + self.size])

    def is_in(self, data: bytes) -> bool:
        """Tell whether `data` holds all of it; never, if it is placed from the end."""
        return 0 <= self.at <= len(data) - self.size

    def write(self, value: float) -> bytes:
        """Write `value` as bytes. Raises OverflowError where it does not fit."""
        if self.is_float:
            return struct.pack(self._layout, value)
        return int(value).to_bytes(self.size, self.order, signed=self.number_type.low < 0)


@dataclass(frozen=True)
class Text:
    """Text in a fixed number of bytes; zeros at its end are no part of it."""

    role: ClassVar = "text"

    name: str
    at: int
    size: int
    charset: str
    field: NumberField

    def value(self, data: bytes) -> str:
        """Read the text. Raises UnicodeDecodeError for other characters."""
        return data.rstrip(b"\0").decode(self.charset)

    def write(self, text: str) -> bytes:
        """Write the text, which fits, as bytes. Raises UnicodeEncodeError."""
        return text.encode(self.charset).ljust(self.size, b"\0")


@dataclass(frozen=True)
class Items:
    """A list: elements each with the same slots, as many as `low` to `high`.

    `element` is the name of an element with several fields, None for bare numbers. `counters` are
    the fields that say how many there are, or how many bytes they have; where there is none, the
    list is of a fixed size, or whatever the length of the frame leaves. `text` is its character
    set, if it is text of a size that varies.
    """

    role: ClassVar = "list"

    name: str
    at: int
    element: str | None
    slots: tuple[Number | Text | Constant, ...]
    counters: tuple[Number, ...]
    low: int
    high: int
    field: ListField | NumberField

    @cached_property
    def size(self) -> int:
        """The size of an element in bytes."""
        return sum(slot.size for slot in self.slots)

    @cached_property
    def fields(self) -> tuple[Number | Text, ...]:
        """The numbers and texts of an element, without the constants between them."""
        return tuple(slot for slot in self.slots if not isinstance(slot, Constant))

    @property
    def counter(self) -> Number | None:
        """The field that says first how long it is, if there is one."""
        return self.counters[0] if self.counters else None

    @property
    def is_fixed(self) -> bool:
        """Whether it always has the same number of elements."""
        return not self.counters and self.low == self.high

    @cached_property
    def text(self) -> str | None:
        """The characters of a list that is text."""
        return getattr(self.field, "text", None)

    @property
    def variable(self) -> str | None:
        """The name by which a length rule depends on it; None for a fixed size."""
        if self.is_fixed:
            return None
        return next((each.name for each in self.counters if each.role == "count"), self.name)

    def counted(self, counter: Number, count: int) -> int:
        """Return the value of a counter for so many elements: their number, or their bytes."""
        return count * self.size if counter.role == "size" else count

    def count_at(self, value: int) -> int | None:
        """Return how many elements a value of the counter means; None where there can be none."""
        is_size = self.counter is not None and self.counter.role == "size"
        count, rest = divmod(value, self.size) if is_size else (value, 0)
        return count if not rest and self.low <= count <= self.high else None

    def path(self, index: int | str, field: Number | Text | Constant) -> str:
        """Return the path of a number in an element: `targets[0].position`, or `ids[0]`."""
        inner = "" if self.element is None else f".{field.name}"
        return f"{self.name}[{index}]{inner}"


@dataclass(frozen=True)
class Packed:
    """A list of a fixed number of unsigned numbers, whose bits stand behind each other.

    In the order `little`, the lowest bit of the first number is the lowest of the first byte; in
    the order `big`, its highest bit is the highest of the first byte.
    """

    role: ClassVar = "packed"

    name: str
    at: int
    number_type: NumberType
    count: int
    order: ByteOrder
    field: NumberField

    @cached_property
    def size(self) -> int:
        """The size of all of them in bytes."""
        return self.count * self.number_type.bits // 8

    @property
    def low(self) -> int:
        """The lowest value allowed."""
        return 0 if self.field.range is None else self.field.range.low

    @property
    def high(self) -> int:
        """The highest value allowed."""
        declared = self.field.range
        return self.number_type.high if declared is None or declared.high is None else declared.high

    def values(self, data: bytes) -> list[int]:
        """Read the numbers."""
        bits, mask = self.number_type.bits, self.number_type.high
        whole = int.from_bytes(data, self.order)
        found = [whole >> bits * number & mask for number in range(self.count)]
        return found if self.order == "little" else found[::-1]

    def write(self, values: Sequence[int]) -> bytes:
        """Write the numbers as bytes."""
        whole = 0
        for value in reversed(values) if self.order == "little" else values:
            whole = whole << self.number_type.bits | value
        return whole.to_bytes(self.size, self.order)


@dataclass(frozen=True)
class Body:
    """The place of a message's fields in an envelope."""

    role: ClassVar = "body"

    name: str
    at: int
    about: str = ""


# Those of a message, whose fields stand where its envelope has the body.
MessageSlot: TypeAlias = Constant | Number | Text | Items | Packed
Field: TypeAlias = Number | Text | Items | Packed
Slot: TypeAlias = MessageSlot | Body


@dataclass(frozen=True, slots=True)
class Placed:
    """A slot in a frame of known size, with its path and its place."""

    path: str
    at: int
    size: int
    slot: Constant | Number | Text | Packed | Body

    @property
    def end(self) -> int:
        """The offset behind the last byte."""
        return self.at + self.size

    def of(self, frame: bytes) -> bytes:
        """Return its bytes, as far as `frame` holds them."""
        return frame[self.at : self.at + self.size]


def lay_out(slots: Iterable[Slot], size: int, count: int = 0) -> Iterator[Placed]:
    """Place the slots of a frame of `size` bytes with `count` elements, in order.

    A list of a fixed size has its own number of them.
    """
    slots = list(slots)
    for slot in slots:
        at = _from_front(slot.at, size)
        match slot:
            case Items():
                for index in range(slot.low if slot.is_fixed else count):
                    start = at + index * slot.size
                    for each in slot.slots:
                        path = slot.path(index, each)
                        yield Placed(path, start + each.at, each.size, each)
            case Body():
                fixed = sum(each.size for each in slots if not isinstance(each, Body | Items))
                yield Placed(slot.name, at, size - fixed, slot)
            case _:
                yield Placed(slot.name, at, slot.size, slot)


def _from_front(at: int, size: int) -> int:
    """Convert a place that may count from the end of a frame into an offset."""
    return at if at >= 0 else size + at
