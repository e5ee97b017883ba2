"""Fields that are lists: where they begin, what they hold, how they are read and checked."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import repeat
from struct import Struct, calcsize

from .bytes_like import as_bytes
from .errors import EncodeError
from .field import Field
from .number import Number, order_of, shown

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any, TypeVar, overload

    from .element import Element

    Item = TypeVar("Item")

_LISTS = (list, tuple)
_BYTES = (bytes, bytearray, memoryview)
# Iterable values that are no list of numbers all the same: text, bytes, and what has no order.
_NO_LISTS = (str, bytes, bytearray, memoryview, dict, set, frozenset)


class Items(Field["tuple[Item, ...]"]):
    """The list at the end of a message, from `least` to `most` elements, as many as `count` says.

    `at` is the offset of its first byte; each element is an `of`: a class of elements, or a number.
    A list of pairs may be given as a mapping of the first to the second.
    """

    __slots__ = (
        "_plain",
        "_unpackers",
        "at",
        "count",
        "element",
        "fields",
        "layout",
        "least",
        "most",
        "order",
        "width",
    )

    if TYPE_CHECKING:

        @overload
        def __init__(
            self: Items[int], at: int, of: Number, least: int, most: int, *, count: Number
        ) -> None: ...
        @overload
        def __init__(
            self, at: int, of: type[Item], least: int, most: int, *, count: Number
        ) -> None: ...

    def __init__(self, at: int, of: Any, least: int, most: int, *, count: Number) -> None:
        self.at = at
        is_class = isinstance(of, type)
        self.element: type[Element] | None = of if is_class else None
        self.fields: tuple[Number, ...] = of.FIELDS if is_class else (of,)
        self.width = len(self.fields)
        self.least = least
        self.most = most
        self.count = count
        # The byte order in which `struct` reads and packs them.
        self.order = order_of(self.fields)
        self.layout = "".join(field.code for field in self.fields)
        self._plain = frozenset([*_LISTS, of])
        self._unpackers: dict[int, Callable[[bytes], tuple[int, ...]]] = {}

    @property
    def derived(self) -> tuple[str, ...]:
        """The names of what follows from it, and is not given."""
        return (self.count.name,)

    @property
    def counts(self) -> range:
        """How many elements there may be."""
        return range(self.least, self.most + 1)

    def reader(self) -> Callable[[Any], tuple[Item, ...]]:
        """Return a function that reads the list from the bytes of a message."""
        at = self.at
        if self.element is None:
            self.fields[0].name = self.name
            if self.layout == "B":
                return lambda message: tuple(message._frame[at:])
            return lambda message: self.numbers(message._frame)
        # Equivalent to calling the class, and several times as fast.
        make: Any = tuple.__new__
        kinds = repeat(self.element)
        read = Struct(self.order + self.layout).iter_unpack
        return lambda message: tuple(map(make, kinds, read(message._frame[at:])))

    def numbers(self, frame: bytes) -> Any:
        """Return all numbers of all elements of a legal frame, in order."""
        unpack = self._unpackers.get(len(frame)) or self._unpacker(len(frame))
        return unpack(frame)

    def _unpacker(self, size: int) -> Callable[[bytes], tuple[int, ...]]:
        """Return a function, made once for each size, that unpacks the list of such a frame."""
        count = (size - self.at) // calcsize(self.order + self.layout)
        unpack = Struct(f"{self.order}{self.at}x{count * self.layout}").unpack
        self._unpackers[size] = unpack
        return unpack

    def flat(self, values: Any) -> Sequence[int]:
        """Return all numbers of all elements, in order. Raises EncodeError if it is no such list.

        Whole numbers in plain lists are not checked closely: packing them will show. Those of one
        byte may be given as bytes.
        """
        if type(values) in _LISTS and self.least <= len(values) <= self.most:
            flat: Sequence[int] | None
            if self.element is None:
                flat = _plain_numbers(values)
            elif self.width == 2:
                flat = _plain_pairs(values, self._plain)
            else:
                flat = _plain_rows(values, self._plain, self.width)
            if flat is not None:
                return flat
        if isinstance(values, _BYTES) and self.element is None and self.layout == "B":
            return self.flat(tuple(as_bytes(values)))
        return self.checked(values)

    def checked(self, values: Any) -> list[int]:
        """Return all numbers of all elements. Raises EncodeError for the first bad one."""
        items = self.listed(values)
        if items is None:
            raise EncodeError(self.name, values, f"{shown(values)} is not a list of {self._wanted}")
        if not self.least <= len(items) <= self.most:
            bounds = f"{self.least}..{self.most}"
            raise EncodeError(self.name, values, f"{len(items)} items is outside {bounds}")
        numbers: list[int] = []
        for position, item in enumerate(items):
            numbers += self.checked_one(item, position)
        return numbers

    def listed(self, values: Any) -> tuple[Any, ...] | None:
        """Return the elements given as a list, or pairs as a mapping; None if it is neither."""
        if self.element is not None and self.width == 2 and isinstance(values, Mapping):
            return tuple(values.items())
        return as_tuple(values)

    def checked_one(self, item: Any, position: int) -> list[int]:
        """Return the numbers of the element at a position. Raises EncodeError for a bad one."""
        parts = (item,) if self.element is None else as_tuple(item)
        if parts is None or len(parts) != len(self.fields):
            problem = f"{shown(item)} is not {self._wanted}"
            raise EncodeError(f"{self.name}[{position}]", item, problem)
        named = zip(parts, self.one(position), strict=True)
        return [field.checked(part, path) for part, (path, field) in named]

    def one(self, position: int) -> list[tuple[str, Number]]:
        """Return the fields of the element at a position, each with its path: `items[1].level`."""
        path = f"{self.name}[{position}]"
        if self.element is None:
            return [(path, self.fields[0])]
        return [(f"{path}.{field.name}", field) for field in self.fields]

    @property
    def _wanted(self) -> str:
        if self.element is None:
            return "whole numbers"
        return f"({', '.join(field.name for field in self.fields)})"


def _plain_numbers(values: Sequence[Any]) -> Sequence[int] | None:
    """Return these values if they are ints, otherwise None."""
    for number in values:
        if type(number) is not int:
            return None
    return values


def _plain_pairs(values: Sequence[Any], plain: frozenset[Any]) -> list[int] | None:
    """Return the numbers of pairs of ints; None if there is anything else. Pairs are usual."""
    numbers: list[int] = []
    try:
        for pair in values:
            if type(pair) is not tuple and type(pair) not in plain:
                return None
            first, second = pair
            if type(first) is not int or type(second) is not int:
                return None
            numbers += pair
    except ValueError:  # more than two, or less
        return None
    return numbers


def _plain_rows(values: Sequence[Any], plain: frozenset[Any], width: int) -> Sequence[int] | None:
    """Return the numbers of rows of `width` ints; None if there is anything else."""
    numbers: list[int] = []
    for row in values:
        if type(row) not in plain or len(row) != width:
            return None
        numbers += row
    return _plain_numbers(numbers)


def as_tuple(value: Any) -> tuple[Any, ...] | None:
    """Return `value` as a tuple; None if it has no order, or is text or bytes."""
    if isinstance(value, _NO_LISTS):
        return None
    try:
        iterator = iter(value)
    except TypeError:
        return None
    return tuple(iterator)
