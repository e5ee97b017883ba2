"""The base of all messages: a frame proven legal, whose fields are read from it on demand."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from struct import Struct, error

from .direction import Direction
from .envelope import Envelope
from .fixed import Always
from .shape import Shape
from .table import ANY_SIZE, Table

TYPE_CHECKING = False
if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from .typing_later import typing

_new = object.__new__

# So many layouts are remembered at once: a list of bytes has one for each length.
_REMEMBERED = 1024


class _Packers(dict[str, "Callable[..., bytes]"]):
    """Functions that pack values, by layout in the notation of `struct`; made once for each."""

    def __missing__(self, layout: str) -> Callable[..., bytes]:
        if len(self) >= _REMEMBERED:
            self.clear()
        self[layout] = Struct(layout).pack
        return self[layout]


_packers = _Packers()


class Message:
    """One message, in one direction.

    It holds nothing but its frame, and is immutable, hashable and equal to any message of the same
    class with the same frame. Each one that exists has been checked, so `encode` cannot fail.
    """

    __slots__ = ("__weakref__", "_frame")
    __match_args__: typing.ClassVar[tuple[str, ...]] = ()

    VENDOR_NAME: typing.ClassVar[str] = ""
    DEPRECATED: typing.ClassVar[str] = ""
    COMMAND: typing.ClassVar[int]
    DIRECTION: typing.ClassVar[Direction]
    FRAME: typing.ClassVar[Envelope]
    IDS: typing.ClassVar[tuple[int, ...]]
    LENGTHS: typing.ClassVar[Sequence[int]]
    CONSTANTS: typing.ClassVar[tuple[Always, ...]] = ()
    DEFAULTS: typing.ClassVar[tuple[tuple[str, object], ...]] = ()
    SHAPE: typing.ClassVar[Shape]

    _frame: bytes
    _table: typing.ClassVar[typing.Any] = None

    def __new__(cls) -> typing.Self:
        # Not in `__init__`, which anybody may call once more, to change what never changes.
        raise TypeError("Message is what all messages are: make one of its subclasses instead")

    def __init_subclass__(cls) -> None:
        cls.SHAPE = Shape(cls, cls.LENGTHS)
        # Made when it is first asked for; that of another class is none of its own.
        cls._table = None

    @classmethod
    def _packed_at_once(
        cls,
        layout: str,
        head: tuple[typing.Any, ...],
        fields: tuple[typing.Any, ...],
        flat: Sequence[int] = (),
    ) -> typing.Self:
        """Return the message with this frame, packed as `struct` does it. Raises EncodeError.

        `fields` are the numbers behind the head, and `flat` those of the list; there is no
        checksum. Good ones are packed at once; any others are checked one by one, and are either
        converted, as those of NumPy are, or explained.
        """
        pack, good = _packers[layout], True
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

    @classmethod
    def _packed(cls, layout: str, *values: typing.Any) -> typing.Self:
        """Return the message with this frame, packed as `struct` does it, with its checksums.

        The values are good ones, each given or derived; where a checksum stands there are zeros.
        """
        message = _new(cls)
        message._frame = cls.FRAME.seal(_packers[layout](*values), cls.IDS)
        return message

    def encode(self) -> bytes:
        """Return the frame, from its header to its last byte."""
        return self._frame

    @classmethod
    def decode(cls, frame: bytes | bytearray | memoryview) -> typing.Self:
        """Decode one frame of this message, with nothing after it. Raises DecodeError."""
        table: typing.Any = cls._table
        if table is None:
            if cls is Message:
                problem = "Message is what all messages are: decode with one of its subclasses"
                raise TypeError(f"{problem}, or with the function `decode` of this package")
            table = cls._table = Table([cls], ANY_SIZE, cls.FRAME.heads)
        message: typing.Self = table.read(frame)
        return message

    def to_dict(self) -> dict[str, typing.Any]:
        """Return the fields by name, as JSON holds them; each element of a list as a dict, too."""
        from .plain_data import to_dict

        return to_dict(self)

    @classmethod
    def from_dict(cls, fields: Mapping[str, typing.Any]) -> typing.Self:
        """Return the message with these fields, as `to_dict` gives them. Raises EncodeError."""
        from .plain_data import values_of

        make: typing.Any = cls
        made: typing.Self = make(**values_of(cls, fields))
        return made

    def __replace__(self, **changes: typing.Any) -> typing.Self:
        # As `copy.replace` wants it.
        make: typing.Any = type(self)
        fields = {name: getattr(self, name) for name in self.__match_args__}
        made: typing.Self = make(**{**fields, **changes})
        return made

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

    def _repr_html_(self) -> str:
        from .html_strip import message_strip

        return message_strip(self)
