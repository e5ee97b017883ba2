"""Describes the fields of messages, and checks the values given for them.

A message that is given good values never asks for these checks: they explain what is wrong with bad
ones, and they turn whatever counts as a whole number elsewhere (such as NumPy's) into an int.
"""

from __future__ import annotations

from operator import index

from .errors import EncodeError

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import Any


_LISTS = (list, tuple)
# What can be gone through, and is still no list of numbers: text, bytes, and what has no order.
_NO_LISTS = (str, bytes, bytearray, memoryview, dict, set, frozenset)


class Number:
    """A whole number: its name, its letter in `struct`, its range, unit and named values.

    `names` maps the names that some values have to those values, such as `{"off": 0}`.
    """

    __slots__ = ("code", "high", "low", "name", "names", "unit")

    def __init__(
        self,
        name: str,
        code: str,
        low: int,
        high: int,
        *,
        unit: str = "",
        names: Mapping[str, int] | None = None,
    ) -> None:
        self.name = name
        self.code = code
        self.low = low
        self.high = high
        self.unit = unit
        self.names: Mapping[str, int] = names or {}

    def checked(self, value: Any, path: str) -> int:
        """`value` as an int. Raises EncodeError where it is none, or outside the range."""
        # NumPy's truth values are numbers to its older versions, so their type has to be asked.
        if isinstance(value, bool) or str(getattr(value, "dtype", "")) == "bool":
            problem = f"{shown(value)} is a truth value, not a whole number"
            raise EncodeError(path, value, problem)
        try:
            number = index(value)
        except TypeError:
            problem = f"{shown(value)} is not a whole number, but {_kind(value)}"
            raise EncodeError(path, value, problem) from None
        if not self.low <= number <= self.high:
            raise EncodeError(path, value, f"{shown(number)} is outside {self.low}..{self.high}")
        return number


class Items:
    """The list at the end of a message: its elements, how many there may be, and their count.

    `element` makes one element of its fields; it is None where the elements are bare numbers.
    `counter` is the position of the count among the numbers in front of the list.
    """

    __slots__ = ("_plain", "counter", "counts", "element", "fields", "name", "width")

    def __init__(
        self,
        name: str,
        fields: tuple[Number, ...],
        counts: range,
        *,
        counter: int,
        element: Callable[..., tuple[int, ...]] | None = None,
    ) -> None:
        self.name = name
        self.fields = fields
        self.width = len(fields)
        self.counts = counts
        self.counter = counter
        self._plain = frozenset([*_LISTS, element])
        self.element = element

    def flat(self, values: Any) -> Sequence[int]:
        """All numbers of all elements, if every element is a plain one. Raises TypeError if not.

        The numbers themselves are not looked at.
        """
        if type(values) not in _LISTS:
            raise TypeError
        if self.element is None:
            known: Sequence[int] = values
            return known
        plain, width = self._plain, self.width
        numbers: list[int] = []
        for item in values:
            if type(item) not in plain or len(item) != width:
                raise TypeError
            numbers += item
        return numbers

    def checked(self, values: Any) -> list[int]:
        """All numbers of all elements, in order. Raises EncodeError naming the first wrong one."""
        items = as_tuple(values)
        if items is None:
            raise EncodeError(self.name, values, f"{shown(values)} is not a list of {self._wanted}")
        if len(items) not in self.counts:
            bounds = f"{self.counts[0]}..{self.counts[-1]}"
            raise EncodeError(self.name, values, f"{len(items)} items is outside {bounds}")
        numbers: list[int] = []
        for position, item in enumerate(items):
            numbers += self.checked_one(item, f"{self.name}[{position}]")
        return numbers

    def checked_one(self, item: Any, path: str) -> list[int]:
        """The numbers of one element. Raises EncodeError, which names what stands at `path`."""
        if self.element is None:
            return [self.fields[0].checked(item, path)]
        parts = as_tuple(item)
        if parts is None or len(parts) != len(self.fields):
            raise EncodeError(path, item, f"{shown(item)} is not {self._wanted}")
        return [
            field.checked(part, f"{path}.{field.name}")
            for field, part in zip(self.fields, parts, strict=True)
        ]

    @property
    def _wanted(self) -> str:
        if self.element is None:
            return "whole numbers"
        return f"({', '.join(field.name for field in self.fields)})"


def as_tuple(value: Any) -> tuple[Any, ...] | None:
    """What `value` holds; None where it holds nothing in order, or is text or bytes."""
    if isinstance(value, _NO_LISTS):
        return None
    try:
        iterator = iter(value)
    except TypeError:
        return None
    return tuple(iterator)


def shown(value: object) -> str:
    """`value` for an error message, cut short where it would flood it."""
    if isinstance(value, int) and value.bit_length() > 128:
        return f"an integer of {value.bit_length()} bits"
    try:
        text = repr(value)
    except ValueError:  # Python refuses to write out integers of thousands of digits
        return _kind(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _kind(value: object) -> str:
    name = type(value).__name__
    return "nothing" if value is None else f"{'an' if name[0] in 'aeiou' else 'a'} {name}"
