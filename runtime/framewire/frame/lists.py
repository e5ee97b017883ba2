"""Fields that are lists: of a fixed size, or of one in bytes; with anything in them."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import repeat
from struct import Struct, error, pack

from .bytes_like import as_bytes
from .errors import EncodeError
from .field import Field, repeated
from .fixed import Always
from .number import ANY_ORDER, Number, notation_of, order_of, shown
from .quick_tests import element_test, item_test

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from typing import Any, TypeVar, overload

    from .element import Element
    from .field import Place

    Item = TypeVar("Item")
    Bare = TypeVar("Bare", int, float)

_LISTS = (list, tuple)
_BYTES = (bytes, bytearray, memoryview)
# Iterable values that are no list of numbers all the same: text, bytes, and what has no order.
_NO_LISTS = (str, bytes, bytearray, memoryview, dict, set, frozenset)
# What unpacks a list is made once for so many sizes, and for so many elements.
_REMEMBERED = 256


class List(Field["tuple[Item, ...]"]):
    """A list from `least` to `most` elements, as many as `count` says, or as bytes as `size` says.

    With neither, it is as long as the frame, of which `tail` bytes stand behind it; with as many
    at least as at most, it is of a fixed size, wherever it stands. `at` is the offset of its first
    byte; each element is an `of`: a class of elements, or a field. A list of pairs may be given as
    a mapping of the first to the second.
    """

    __slots__ = (
        "_plain",
        "_unpackers",
        "at",
        "count",
        "counters",
        "element",
        "end",
        "fields",
        "is_read",
        "layout",
        "least",
        "most",
        "narrowed",
        "order",
        "pieces",
        "size",
        "tail",
        "tight",
        "unit_size",
        "width",
    )

    if TYPE_CHECKING:

        @overload
        def __init__(
            self: List[Bare],
            at: int,
            of: Field[Bare],
            least: int,
            most: int,
            *,
            count: Number | None = None,
            size: Number | None = None,
            tail: int = 0,
        ) -> None: ...
        @overload
        def __init__(
            self,
            at: int,
            of: type[Item],
            least: int,
            most: int,
            *,
            count: Number | None = None,
            size: Number | None = None,
            tail: int = 0,
        ) -> None: ...

    def __init__(
        self,
        at: int,
        of: Any,
        least: int,
        most: int,
        *,
        count: Number | None = None,
        size: Number | None = None,
        tail: int = 0,
    ) -> None:
        self.at = at
        is_class = isinstance(of, type)
        self.element: type[Element] | None = of if is_class else None
        self.fields: tuple[Any, ...] = vars(of)["FIELDS"] if is_class else (of,)
        self.width = len(self.fields)
        self.least = least
        self.most = most
        constants = vars(of).get("CONSTANTS", ()) if is_class else ()
        self.pieces = sorted([*self.fields, *constants], key=lambda piece: piece.at)
        # The byte order in which `struct` reads and packs them.
        self.order = order_of(self.fields)
        # Whether `struct` unpacks the values of all elements as they are, and packs them as well.
        self.is_read = all(is_read(piece, self.order) for piece in self.pieces)
        self.tight = all(_is_tight(piece, self.order) for piece in self.pieces)
        self.layout = "".join(_notation(piece, self.order) for piece in self.pieces)
        self.unit_size = sum(map(size_of, self.pieces))
        # Whether there are numbers in it whose range is narrower than their type.
        self.narrowed = any(getattr(field, "narrowed", False) for field in self.fields)
        self.counters = tuple(
            (number, factor)
            for number, factor in ((count, 1), (size, self.unit_size))
            if number is not None
        )
        # The numbers that say it, each a field of its own; None where there is none.
        self.count: Any = count
        self.size: Any = size
        self.tail = tail
        self.end = -tail or None if self.varies else at + most * self.unit_size
        self._plain = frozenset([*_LISTS, of])
        self._unpackers: dict[int, Callable[[bytes], tuple[Any, ...]]] = {}

    @property
    def counts(self) -> range:
        """How many elements there may be."""
        return range(self.least, self.most + 1)

    @property
    def varies(self) -> bool:
        """Whether its size varies from frame to frame."""
        return bool(self.counters) or self.least != self.most

    @property
    def derived(self) -> tuple[str, ...]:
        """The names of what follows from it, and is not given."""
        return tuple(number.name for number, _ in self.counters)

    @property
    def each(self) -> list[Place]:
        """What can be wrong in an element."""
        return [place for piece in self.pieces for place in piece.places]

    @property
    def places(self) -> Sequence[Place]:
        """What can be wrong in it, if it is of a fixed size."""
        return [*self.places_of(self.most)]

    def places_of(self, count: int, since: int = 0) -> Iterator[Place]:
        """Yield what can be wrong in so many elements; what ends at `since` or before is not."""
        return repeated(self.each, self.at, self.unit_size, count, since)

    def tests(self) -> list[Callable[[bytes], bool]]:
        """Return what say of a frame whether all elements are right."""
        each = self.each
        if not each:
            return []
        if self.element is None:
            return [item_test(self.numbers, self.fields[0])]
        return [element_test(each, slice(self.at, -self.tail or None), self.unit_size)]

    def within(self, body: bytes, /) -> Iterator[tuple[str, int, Any]]:
        """Yield what its elements hold, by its path, and where the place of that counts from."""
        end = len(body) if self.varies else self.at + self.most * self.unit_size
        for position, at in enumerate(range(self.at, end, self.unit_size)):
            for piece in self.pieces:
                inner = f".{piece.name}" if self.element is not None else ""
                yield f"{self.name}[{position}]{inner}", at, piece

    def reader(self) -> Callable[[Any], tuple[Item, ...]]:
        """Return a function that reads the list from the bytes of a message."""
        place = slice(self.at, self.end)
        if self.element is None:
            self.fields[0].name = self.name
            if self.layout == "B":
                return lambda message: tuple(message._frame[place])
            return lambda message: self.numbers(message._frame)
        # Equivalent to calling the class, and several times as fast.
        make: Any = tuple.__new__
        kinds = repeat(self.element)
        rows = Struct(self.order + self.layout).iter_unpack
        if self.is_read:
            return lambda message: tuple(map(make, kinds, rows(message._frame[place])))
        read = self._read
        return lambda message: tuple(map(make, kinds, map(read, rows(message._frame[place]))))

    def numbers(self, frame: bytes) -> Any:
        """Return all values of all elements of a legal frame, in order."""
        unpack = self._unpackers.get(len(frame)) or self._unpacker(len(frame))
        return unpack(frame)

    def _unpacker(self, size: int) -> Callable[[bytes], tuple[Any, ...]]:
        """Return a function that unpacks the list of a frame of a size."""
        if not self.is_read:
            return self._all_read
        listed = len(range(size)[self.at : self.end])
        count, behind = listed // self.unit_size, size - self.at - listed
        layout = f"{count}{self.layout}" if len(self.layout) == 1 else count * self.layout
        unpack = Struct(f"{self.order}{self.at}x{layout}{behind}x").unpack
        if count <= _REMEMBERED:
            if len(self._unpackers) >= _REMEMBERED:
                self._unpackers.clear()
            self._unpackers[size] = unpack
        return unpack

    def _all_read(self, frame: bytes) -> tuple[Any, ...]:
        """Return the values of all elements of which `struct` knows only the bytes of some."""
        rows = Struct(self.order + self.layout).iter_unpack(frame[self.at : self.end])
        return tuple(value for row in map(self._read, rows) for value in row)

    def _read(self, row: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return the values of an element of which `struct` knows only the bytes of some."""
        return tuple(
            value if is_read(field, self.order) else field.struct.unpack(value)[0]
            for field, value in zip(self.fields, row, strict=True)
        )

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

    def packed(self, values: Any) -> bytes:
        """Return the bytes of all elements. Raises EncodeError for the first bad one.

        Numbers of one byte may be given as bytes.
        """
        if isinstance(values, _BYTES) and self.element is None and self.layout == "B":
            values = tuple(as_bytes(values))
        if self.tight and not self.narrowed:
            flat = self.flat(values)
            try:
                if self.layout == "B":
                    return bytes(flat)
                return pack(f"{self.order}{len(flat) // self.width * self.layout}", *flat)
            except (error, ValueError):
                pass
        checked = iter(self.checked(values))
        data = b""
        for first in checked:
            row = [first, *(next(checked) for _ in self.fields[1:])]
            data += b"".join(self._written(row))
        return data

    def _written(self, row: list[Any]) -> Iterator[bytes]:
        """Yield the bytes of the pieces of an element."""
        values = iter(row)
        for piece in self.pieces:
            if isinstance(piece, Always):
                yield piece.data
            else:
                yield piece.struct.pack(next(values))

    @property
    def _wanted(self) -> str:
        if self.element is not None:
            return f"({', '.join(field.name for field in self.fields)})"
        return "whole numbers" if isinstance(self.fields[0], Number) else "numbers"


def size_of(piece: Any) -> int:
    """Return the number of bytes of a number, a text or a constant."""
    size: int = len(piece.data) if isinstance(piece, Always) else piece.struct.size
    return size


def is_read(piece: Any, order: str) -> bool:
    """Tell whether `struct` reads it in an order as it is: no text, and of a size that it knows."""
    return isinstance(piece, Always) or notation_of(piece).startswith((order, ANY_ORDER))


def _is_tight(piece: Any, order: str) -> bool:
    """Tell whether `struct` also writes it: bytes that nobody gives are zero."""
    return not any(piece.data) if isinstance(piece, Always) else is_read(piece, order)


def _notation(piece: Any, order: str) -> str:
    """Return what `struct` reads it as: bytes, where it knows nothing better."""
    if isinstance(piece, Always):
        return f"{len(piece.data)}x"
    code: str = piece.code
    return code if is_read(piece, order) else f"{size_of(piece)}s"


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
