"""The base of all messages: a frame proven legal, whose fields are read from it on demand."""

from __future__ import annotations

from struct import Struct, error

from .shape import Shape
from .table import ANY_SIZE, Table

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any, ClassVar

    from typing_extensions import Self

    from .direction import Direction

_new = object.__new__


class _Packers(dict[str, "Callable[..., bytes]"]):
    """Functions that pack values, by layout in the notation of `struct`; made once for each."""

    def __missing__(self, layout: str) -> Callable[..., bytes]:
        self[layout] = Struct(layout).pack
        return self[layout]


_packers = _Packers()


class Message:
    """One message, in one direction.

    It holds nothing but its frame, and is immutable, hashable and equal to any message of the same
    class with the same frame. Each one that exists has been checked, so `encode` cannot fail.
    """

    __slots__ = ("__weakref__", "_frame")
    __match_args__: ClassVar[tuple[str, ...]] = ()

    VENDOR_NAME: ClassVar[str] = ""
    COMMAND: ClassVar[int]
    DIRECTION: ClassVar[Direction]
    LENGTHS: ClassVar[range]
    SHAPE: ClassVar[Shape]

    _frame: bytes
    _table: ClassVar[Any]

    def __new__(cls) -> Self:
        # Not in `__init__`, which could be called again to change an immutable message.
        raise TypeError("Message is what all messages are: make one of its subclasses instead")

    def __init_subclass__(cls) -> None:
        cls.SHAPE = Shape(cls, cls.LENGTHS)
        cls._table = Table([cls], ANY_SIZE)

    @classmethod
    def _packed(
        cls, layout: str, head: tuple[Any, ...], fields: tuple[Any, ...], flat: Sequence[int] = ()
    ) -> Self:
        """Return the message with this frame, packed as `struct` does it. Raises EncodeError.

        `fields` are the numbers behind the head, and `flat` those of the list. Good ones are packed
        at once; any others are checked one by one, and are either converted, as those of NumPy are,
        or explained.
        """
        pack, good = _packers[layout], not cls.SHAPE.narrowed
        for number in fields:
            if type(number) is not int:
                good = False
        message = _new(cls)
        if good:
            try:
                message._frame = pack(*head, *fields, *flat)
            except error:
                good = False
        if not good:
            message._frame = pack(*head, *cls.SHAPE.checked((*fields, *flat)))
        return message

    def encode(self) -> bytes:
        """Return the frame, from its header to its last byte."""
        return self._frame

    @classmethod
    def decode(cls, frame: bytes | bytearray | memoryview) -> Self:
        """Decode one frame of this message, with nothing after it. Raises DecodeError."""
        try:
            table = cls._table
        except AttributeError:
            problem = "Message is what all messages are: decode with one of its subclasses"
            raise TypeError(f"{problem}, or with the function `decode` of this package") from None
        message: Self = table.read(frame)
        return message

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Message):
            return NotImplemented
        return type(self) is type(other) and self._frame == other._frame

    def __hash__(self) -> int:
        return hash((type(self), self._frame))

    def __reduce__(self) -> tuple[object, ...]:
        # By its frame, which is checked again on loading.
        return type(self).decode, (self._frame,)

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.__match_args__)
        return f"{type(self).__name__}({fields})"
