"""The base of all fields of messages: a field is a property that knows its place."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from typing import Any, ClassVar, Generic, TypeAlias, TypeVar, overload

    from typing_extensions import Never, Self

    Value = TypeVar("Value")

    # From where to where something can be wrong in the bytes of a field, and what must be there, or
    # what tells where it is wrong, None for nowhere.
    Due: TypeAlias = "bytes | Callable[[bytes], int | None]"
    Place: TypeAlias = "tuple[int, int, Due]"

    class _Property(Generic[Value]):
        """A property as type checkers see it: it is read, and never assigned."""

        def __init__(self, read: Callable[[Any], Value]) -> None: ...

        @overload
        def __get__(self, held: None, owner: type) -> Self: ...
        @overload
        def __get__(self, held: object, owner: type) -> Value: ...
        def __get__(self, held: object, owner: type) -> Any: ...

        def __set__(self, held: object, value: Never) -> None: ...

else:

    class _Property(property):
        __slots__ = ()

        def __class_getitem__(cls, value: object) -> type:
            return cls


class Field(_Property["Value"]):
    """A field: `message.level` is its value, `Kind.level` its description (`Kind.level.high`).

    In the class of a message or of an element, it stands in a line of its own, and its
    documentation below.
    """

    __slots__ = ("name", "owner")

    name: str
    owner: type
    plain: ClassVar[bool] = False
    """Whether it is one number."""

    def __init_subclass__(cls) -> None:
        # Otherwise a field would show the documentation of its class.
        type.__setattr__(cls, "__doc__", _Documentation(cls.__doc__))

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name
        self.owner = owner
        super().__init__(self.reader())

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.owner.__name__}.{self.name}>"

    def reader(self) -> Callable[[Any], Value]:
        """Return a function that reads the value from a message, or from an element."""
        raise NotImplementedError

    @property
    def varies(self) -> bool:
        """Whether its size varies from frame to frame."""
        return False

    @property
    def there(self) -> Field[Any]:
        """What it is in a frame in which it is not absent."""
        return self

    @property
    def places(self) -> Sequence[Place]:
        """What can be wrong in it."""
        return ()

    def within(self, _body: bytes, /) -> Iterator[tuple[str, int, Any]]:
        """Yield what it holds in a frame, by its path, and where the place of that counts from."""
        yield self.name, 0, self

    def explained(self, data: bytes, at: int, /) -> str:
        """Return what is wrong with its bytes, at an offset in these."""
        raise NotImplementedError


def repeated(
    places: Sequence[Place], at: int, size: int, count: int, since: int
) -> Iterator[Place]:
    """Yield places of an element of `size` bytes in a list of `count` that begins at an offset.

    What ends at `since` or before it is left out.
    """
    if not places:
        return
    for position in range(max(0, (since - at) // size), count):
        base = at + position * size
        for start, end, due in places:
            if base + end > since:
                yield base + start, base + end, due


class _Documentation:
    """The documentation of a class of fields; for a field, the string below it in the source."""

    def __init__(self, of_class: str | None) -> None:
        self.of_class = of_class

    def __get__(self, field: Field[Any] | None, kind: type) -> str | None:
        if field is None:
            return self.of_class
        # Reading sources takes time, which only a call of `help` should cost.
        from .documentation import documentation

        return documentation(field.owner, field.name)

    def __set__(self, field: Field[Any], doc: object) -> None:
        """Do nothing: a property copies the documentation of its getter."""
