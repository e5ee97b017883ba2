"""The shape of one message on the wire: packs its values, and knows its legal frames."""

from __future__ import annotations

import struct
from itertools import chain, cycle

from .fields import as_tuple
from .protocol import BODY_AT, STRUCT_ORDER, head

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import Any

    from .fields import Items, Number

_INTEGERS = frozenset([int])


class Shape:
    """The wire side of a message class.

    `lengths` are the legal values of the length byte, `numbers` the fields in front of the list
    (its count among them), and `items` the list itself, where there is one.
    """

    __slots__ = ("_packers", "_width", "command", "items", "lengths", "narrowed", "numbers")

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
        self._width = 1 if items is None or items.element is None else len(items.fields)
        self._packers: dict[int, tuple[Callable[..., bytes], bytes]] = {}

    def count_bytes(self, length: int) -> tuple[int, int, bytes]:
        """Where the count of a frame of legal length begins and ends, and what it must be."""
        if self.items is None:
            return 0, 0, b""
        count = self.items.counts[self.lengths.index(length)]
        before = "".join(number.code for number in self.numbers[: self.items.counter])
        at = BODY_AT + struct.calcsize(STRUCT_ORDER + before)
        data = struct.pack(STRUCT_ORDER + self.numbers[self.items.counter].code, count)
        return at, at + len(data), data

    def out_of_range(self, frame: bytes) -> tuple[int, str] | None:
        """The first field of a whole frame that its range does not allow: its offset, and why."""
        if not self.narrowed:
            return None
        fields = chain(self.numbers, cycle(self.items.fields if self.items is not None else ()))
        at = BODY_AT
        for field in fields:
            if at >= len(frame):
                break
            (value,) = struct.unpack_from(STRUCT_ORDER + field.code, frame, at)
            if not field.low <= value <= field.high:
                return at, f"{field.name} is {value}, outside {field.low}..{field.high}"
            at += struct.calcsize(STRUCT_ORDER + field.code)
        return None

    def frame(self, numbers: tuple[int, ...], values: Iterable[Any] = ()) -> bytes:
        """The frame that carries these values. Raises EncodeError.

        Good values are packed at once; anything else is looked at one by one, and comes back
        either converted or explained.
        """
        items = as_tuple(values)
        if items is not None and not self.narrowed:
            try:
                flat = items if self._width == 1 else (*chain.from_iterable(items),)
                integers = _INTEGERS.issuperset(map(type, numbers)) and _INTEGERS.issuperset(
                    map(type, flat)
                )
                if integers and (self._width == 1 or {*map(len, items)} == {self._width}):
                    return self._packed(len(items), numbers, flat)
            except (TypeError, KeyError, struct.error):
                pass  # explained below
        return self._explained(numbers, values if items is None else items)

    def _explained(self, numbers: tuple[Any, ...], values: Any) -> bytes:
        fields = [number for number in self.numbers if not self._is_counter(number)]
        checked = [
            field.checked(value, field.name) for field, value in zip(fields, numbers, strict=True)
        ]
        if self.items is None:
            return self._packed(0, checked, ())
        flat = self.items.checked(values)
        return self._packed(len(flat) // self._width, checked, flat)

    def _is_counter(self, number: Number) -> bool:
        return self.items is not None and self.numbers[self.items.counter] is number

    def _packed(self, count: int, numbers: Iterable[int], flat: Iterable[int]) -> bytes:
        packer, front = self._packers.get(count) or self._packer(count)
        if self.items is None:
            return packer(front, *numbers)
        before = [*numbers]
        before.insert(self.items.counter, count)
        return packer(front, *before, *flat)

    def _packer(self, count: int) -> tuple[Callable[..., bytes], bytes]:
        """For `count` items: what packs them, and the bytes in front. Made once for each count."""
        length = self.lengths[0]
        codes = "".join(number.code for number in self.numbers)
        if self.items is not None:
            if count not in self.items.counts:
                raise KeyError(count)
            length = self.lengths[self.items.counts.index(count)]
            codes += "".join(field.code for field in self.items.fields) * count
        made = struct.Struct(f"{STRUCT_ORDER}{BODY_AT}s{codes}").pack, head(self.command, length)
        self._packers[count] = made
        return made
