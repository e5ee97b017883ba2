"""What all messages are: a frame proven legal, whose fields are read from it when asked for."""

from __future__ import annotations

from .table import ANY_SIZE, Table

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import Any, ClassVar

    from typing_extensions import Self

    from .direction import Direction
    from .shape import Shape


class Message:
    """One message, in one direction.

    It holds nothing but its frame, and is immutable, hashable and equal to any message of the same
    class with the same frame. Whatever exists has been checked, so `encode` cannot fail.
    """

    __slots__ = ("_frame",)
    __match_args__: ClassVar[tuple[str, ...]] = ()

    VENDOR_NAME: ClassVar[str]
    COMMAND: ClassVar[int]
    DIRECTION: ClassVar[Direction]
    LENGTHS: ClassVar[range]
    SHAPE: ClassVar[Shape]

    _frame: bytes
    _table: ClassVar[Any]

    def __init__(self) -> None:
        raise TypeError("Message is what all messages are: make one of its subclasses instead")

    def __init_subclass__(cls) -> None:
        cls._table = Table([cls], ANY_SIZE)

    def encode(self) -> bytes:
        """The frame, from its header to its last byte."""
        return self._frame

    @classmethod
    def decode(cls, frame: bytes | bytearray | memoryview) -> Self:
        """Reads one frame of this message, whole and with nothing after it. Raises DecodeError."""
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
        # By its frame, which is looked at again: whatever exists has been checked.
        return type(self).decode, (self._frame,)

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.__match_args__)
        return f"{type(self).__name__}({fields})"
