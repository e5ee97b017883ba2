"""The shape of one message on the wire: packs its values, and knows its legal frames."""

from __future__ import annotations

import struct
from itertools import chain, cycle

from .fields import as_tuple
from .protocol import BODY_AT, STRUCT_ORDER, head

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from typing import Any

    from .fields import Items, Number

_INTEGERS = frozenset([int])


class Shape:
    """The wire side of a message class.

    `lengths` are the legal values of the length byte, `numbers` the fields in front of the list
    (its count among them), and `items` the list itself, where there is one.
    """

    __slots__ = ("_packers", "_unpackers", "command", "items", "lengths", "narrowed", "numbers")

    def __init__(
        self,
        command: int,
        lengths: range,
        numbers: tuple[Number, ...] = (),
        items: Items | None = None,
        *,
        narrowed: bool = False,
    ) -> None:
        self.command = command
        self.lengths = lengths
        self.numbers = numbers
        self.items = items
        # Whether a field has a range of its own, which what struct accepts says nothing about.
        self.narrowed = narrowed
        self._packers: dict[int, tuple[Callable[..., bytes], bytes]] = {}
        self._unpackers: dict[int, Callable[[bytes], tuple[int, ...]]] = {}

    def count_bytes(self, length: int) -> tuple[int, int, bytes]:
        """Where the count of a frame of legal length begins and ends, and what it must be."""
        if self.items is None:
            return 0, 0, b""
        count = self.items.counts[self.lengths.index(length)]
        before = _codes(self.numbers[: self.items.counter])
        at = BODY_AT + struct.calcsize(STRUCT_ORDER + before)
        data = struct.pack(STRUCT_ORDER + self.numbers[self.items.counter].code, count)
        return at, at + len(data), data

    def out_of_range(self, frame: bytes) -> tuple[int, str] | None:
        """The first field that its range does not allow: its offset, and why.

        Of a frame that is cut off, what is not whole is not looked at.
        """
        if not self.narrowed:
            return None
        fields = chain(self.numbers, cycle(self.items.fields if self.items is not None else ()))
        at = BODY_AT
        for field in fields:
            if at + struct.calcsize(STRUCT_ORDER + field.code) > len(frame):
                break
            (value,) = struct.unpack_from(STRUCT_ORDER + field.code, frame, at)
            if not field.low <= value <= field.high:
                return at, f"{field.name} is {value}, outside {field.low}..{field.high}"
            at += struct.calcsize(STRUCT_ORDER + field.code)
        return None

    def listed(self, frame: bytes) -> tuple[int, ...]:
        """All numbers of the list of a legal frame, in its order; one without a list has none."""
        try:
            unpack = self._unpackers[len(frame)]
        except KeyError:
            unpack = self._unpacker(len(frame))
        return unpack(frame)

    def frame(self, numbers: tuple[Any, ...], given: Iterable[Any] = ()) -> bytes:
        """The frame with these values. Raises EncodeError.

        `numbers` are the fields in front of the list, without its count, and `given` is the list.
        Good values are packed at once; any others are looked at one by one, and either come to
        something after all, as those of NumPy do, or are explained.
        """
        items: Any = given
        if type(given) not in (list, tuple):
            held = as_tuple(given)
            items = given if held is None else held
        try:
            values: Sequence[Any] = numbers
            count = 0
            if self.items is not None:
                at, count = self.items.counter, len(items)
                values = (*numbers[:at], count, *numbers[at:], *self.items.flat(items))
            if not self.narrowed and _INTEGERS.issuperset(map(type, values)):
                pack, front = self._packers.get(count) or self._packer(count)
                return pack(front, *values)
        except (TypeError, ValueError, struct.error):
            pass
        return self._checked(numbers, items)

    def _checked(self, numbers: Sequence[Any], items: Any) -> bytes:
        """The frame with these values, looked at one by one. Raises EncodeError."""
        counter = None if self.items is None else self.numbers[self.items.counter]
        fields = [field for field in self.numbers if field is not counter]
        values = [
            field.checked(number, field.name) for field, number in zip(fields, numbers, strict=True)
        ]
        if self.items is None:
            pack, front = self._packer(0)
            return pack(front, *values)
        flat = self.items.checked(items)
        count = len(flat) // self.items.width
        pack, front = self._packer(count)
        values.insert(self.items.counter, count)
        return pack(front, *values, *flat)

    def _packer(self, count: int) -> tuple[Callable[..., bytes], bytes]:
        """For `count` items: what packs them, and the bytes in front. Made once for each count."""
        length = self.lengths[0]
        codes = _codes(self.numbers)
        if self.items is not None:
            length = self.lengths[self.items.counts.index(count)]
            codes += _codes(self.items.fields) * count
        made = struct.Struct(f"{STRUCT_ORDER}{BODY_AT}s{codes}").pack, head(self.command, length)
        self._packers[count] = made
        return made

    def _unpacker(self, size: int) -> Callable[[bytes], tuple[int, ...]]:
        """What unpacks the list of a frame of this size. Made once for each size."""
        at = BODY_AT + struct.calcsize(STRUCT_ORDER + _codes(self.numbers))
        element = _codes(self.items.fields) if self.items else ""
        count = (size - at) // max(1, struct.calcsize(STRUCT_ORDER + element))
        made = self._unpackers[size] = struct.Struct(f"{STRUCT_ORDER}{at}x{element * count}").unpack
        return made


def _codes(fields: Sequence[Number]) -> str:
    """The letters of these fields in `struct`."""
    return "".join(field.code for field in fields)
