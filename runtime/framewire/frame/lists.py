"""Fields that are lists of any kind: of a fixed size, or of one in bytes; with anything in them."""

from __future__ import annotations

from itertools import repeat
from struct import Struct, error, pack

from .bytes_like import as_bytes
from .fixed import Always
from .items import Items
from .number import ANY_ORDER, Number, notation_of
from .text import Text, misspelt

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any, TypeAlias, TypeVar, overload

    from .field import Field

    Item = TypeVar("Item")
    Bare = TypeVar("Bare", int, float)
    # From where to where something stands in an element, and what must be there, or what tells
    # where its bytes are wrong, None for nowhere.
    Place: TypeAlias = tuple[int, int, "bytes | Callable[[bytes], int | None]"]

_BYTES = (bytes, bytearray, memoryview)
# What unpacks a list is made once for so many sizes, and for so many elements.
_REMEMBERED = 256


class List(Items["Item"]):
    """A list from `least` to `most` elements, as many as `count` says, or as bytes as `size` says.

    With neither, it is as long as the frame, of which `tail` bytes stand behind it; with as many
    at least as at most, it is of a fixed size, wherever it stands.
    """

    __slots__ = (
        "counters",
        "end",
        "is_read",
        "narrowed",
        "pieces",
        "size",
        "tail",
        "tight",
        "unit_size",
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
        is_class = isinstance(of, type)
        fields: Any = vars(of)["FIELDS"] if is_class else (of,)
        constants = vars(of).get("CONSTANTS", ()) if is_class else ()
        self.pieces = sorted([*fields, *constants], key=lambda piece: piece.at)
        unread: Any = count
        super().__init__(at, of, least, most, count=unread)
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
        self.size = size
        self.tail = tail
        fixed = not self.counters and least == most
        self.end = at + most * self.unit_size if fixed else -tail or None

    @property
    def derived(self) -> tuple[str, ...]:
        """The names of what follows from it, and is not given."""
        return tuple(number.name for number, _ in self.counters)

    @property
    def places(self) -> list[Place]:
        """What can be wrong in an element."""
        return [place for piece in self.pieces for place in places_of(piece)]

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
            value if is_read(field, self.order) else _value(field, value)
            for field, value in zip(self.fields, row, strict=True)
        )

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
                yield _bytes(piece, next(values))

    @property
    def _wanted(self) -> str:
        if self.element is None and not isinstance(self.fields[0], Number):
            return "numbers"
        return super()._wanted


def size_of(piece: Any) -> int:
    """Return the number of bytes of a number, a text or a constant."""
    if isinstance(piece, Always):
        return len(piece.data)
    size: int = piece.most if isinstance(piece, Text) else piece.struct.size
    return size


def places_of(piece: Any) -> list[Place]:
    """Return what can be wrong in the bytes of a number, a text or a constant."""
    at, end = piece.at, piece.at + size_of(piece)
    if isinstance(piece, Always):
        return [(at, end, piece.data)] if type(piece) is Always else []
    if isinstance(piece, Text):
        return [(at, end, misspelt)]
    return [(at, end, _judge(piece))] if piece.narrowed else []


def _judge(number: Number) -> Callable[[bytes], int | None]:
    """Return a function that tells whether the bytes of a number are wrong."""
    unpack = number.struct.unpack
    return lambda data: None if number.holds(unpack(data)[0]) else 0


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


def _value(piece: Any, data: bytes) -> Any:
    return piece.read(data) if isinstance(piece, Text) else piece.struct.unpack(data)[0]


def _bytes(piece: Any, value: Any) -> bytes:
    data: bytes = piece.packed(value) if isinstance(piece, Text) else piece.struct.pack(value)
    return data
