"""Fields that are text: in a fixed number of bytes, or in as many as the frame says."""

from __future__ import annotations

from operator import itemgetter

from .errors import EncodeError
from .field import Field, repeated
from .number import kind_of, shown

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from typing import Any, ClassVar

    from .field import Place
    from .number import Number


class Text(Field["str"]):
    """Text in ASCII: the offset of its first byte, in the frame or in its element.

    It has room for `most` characters, and zeros fill up what is left; with `least`, it has from so
    many to so many, as `count` or `size` say, or the length of the frame, of which `tail` bytes
    stand behind it.
    """

    __slots__ = ("at", "count", "least", "most", "size", "tail")

    names: ClassVar[Mapping[str, int]] = {}
    """The names of values: it has none."""
    unit: ClassVar[str] = ""
    """Its unit: it has none."""
    unit_size: ClassVar[int] = 1
    """How many bytes a character has."""

    def __init__(
        self,
        at: int = 0,
        most: int = 0,
        *,
        least: int | None = None,
        count: Number | None = None,
        size: Number | None = None,
        tail: int = 0,
    ) -> None:
        self.at = at
        self.most = most
        self.least = least
        self.count = count
        self.size = size
        self.tail = tail

    @property
    def counts(self) -> range:
        """How many characters there may be."""
        return range(self.least or 0, self.most + 1)

    @property
    def varies(self) -> bool:
        """Whether its size varies from frame to frame."""
        return self.least is not None

    @property
    def counters(self) -> tuple[tuple[Number, int], ...]:
        """The numbers that say how long it is, each with its value of one character."""
        return tuple((each, 1) for each in (self.count, self.size) if each is not None)

    @property
    def struct(self) -> _Letters:
        """What packs and unpacks a fixed number of bytes."""
        return _Letters(self)

    @property
    def code(self) -> str:
        """Its notation in `struct`, of a fixed number of bytes."""
        return f"{self.most}s"

    def reader(self) -> Callable[[Any], str]:
        """Return a function that reads it from the bytes of a message, or from an element."""
        if issubclass(self.owner, tuple):
            return itemgetter(vars(self.owner)["__match_args__"].index(self.name))
        at, end = self.at, -self.tail or None
        if self.least is None:
            end = at + self.most
            return lambda message: self.read(message._frame[at:end])
        return lambda message: str(message._frame[at:end], "ascii")

    def read(self, data: bytes) -> str:
        """Return the text that its fixed number of bytes holds."""
        return str(data.rstrip(b"\0"), "ascii")

    @property
    def places(self) -> Sequence[Place]:
        """What can be wrong in it, if it has a fixed number of bytes."""
        return [(self.at, self.at + self.most, misspelt)]

    def places_of(self, count: int, since: int = 0) -> Iterator[Place]:
        """Yield what can be wrong in so many characters; what ends at `since` or before is not."""
        return repeated([(0, 1, misspelt)], self.at, 1, count, since)

    def tests(self) -> list[Callable[[bytes], bool]]:
        """Return what says of a frame whether all its characters are right."""
        at, end = self.at, -self.tail or None
        return [lambda frame: frame[at:end].isascii()]

    def within(self, body: bytes, /) -> Iterator[tuple[str, int, Any]]:
        """Yield it by its path, and where its place counts from; each character if it varies."""
        if not self.varies:
            yield from super().within(body)
            return
        for position, at in enumerate(range(self.at, len(body))):
            yield f"{self.name}[{position}]", at, Text(0, 1)

    def explained(self, data: bytes, at: int, /) -> str:
        """Return what is wrong with its bytes, at an offset in these."""
        return f"holds 0x{data[at]:02X}, which is no character of ASCII"

    def checked(self, value: Any, path: str) -> str:
        """Return `value`, which is text. Raises EncodeError if it is none, or has no room."""
        return str(self.packed(value, path), "ascii").rstrip("\0")

    def packed(self, value: Any, path: str = "") -> bytes:
        """Return the bytes of a text. Raises EncodeError if it is none, or has no room."""
        path = path or self.name
        if not isinstance(value, str):
            raise EncodeError(path, value, f"{shown(value)} is not text, but {kind_of(value)}")
        try:
            data = value.encode("ascii")
        except UnicodeEncodeError as error:
            wrong = value[error.start]
            problem = f"{shown(wrong)} at {error.start} is not a character of ASCII"
            raise EncodeError(path, value, problem) from None
        if self.least is None:
            if len(data) > self.most:
                problem = f"{len(data)} characters, and there is room for {self.most}"
                raise EncodeError(path, value, problem)
            return data.ljust(self.most, b"\0")
        if not self.least <= len(data) <= self.most:
            problem = f"{len(data)} characters is outside {self.least}..{self.most}"
            raise EncodeError(path, value, problem)
        return data


class _Letters:
    """Packs and unpacks a text, as a `Struct` does it with numbers."""

    __slots__ = ("_text", "size")

    def __init__(self, text: Text) -> None:
        self._text = text
        self.size = text.most

    def pack(self, value: str) -> bytes:
        """Return the text as bytes."""
        return self._text.packed(value)

    def unpack(self, data: bytes) -> tuple[str]:
        """Return the text that these bytes hold, in a tuple."""
        return (self._text.read(data),)


def misspelt(data: bytes) -> int | None:
    """Return the offset of the first byte that is no character of ASCII; None if all are."""
    if data.isascii():
        return None
    return next(at for at, byte in enumerate(data) if byte > 0x7F)
