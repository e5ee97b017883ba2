"""The base of a message's list elements: tuples whose parts have names."""

from __future__ import annotations

from .number import Number

TYPE_CHECKING = False
if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from .typing_later import typing


class Element:
    """A named tuple of numbers: equal to the plain tuple of the same numbers, and as immutable."""

    __slots__ = ()
    __match_args__: typing.ClassVar[tuple[str, ...]] = ()

    FIELDS: typing.ClassVar[tuple[Number, ...]]
    _fields: typing.ClassVar[tuple[str, ...]]

    def __init_subclass__(cls) -> None:
        cls._fields = cls.__match_args__
        cls.FIELDS = tuple(getattr(cls, name) for name in cls._fields)

    def _asdict(self) -> dict[str, int]:
        """Return the numbers by name."""
        return {name: getattr(self, name) for name in self._fields}

    def _replace(self, **changes: int) -> typing.Self:
        """Return another such element, with the given numbers in place of its own."""
        make: typing.Any = type(self)
        other: typing.Self = make(**{**self._asdict(), **changes})
        return other

    __replace__ = _replace  # as `copy.replace` wants it

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={value!r}" for name, value in self._asdict().items())
        return f"{type(self).__name__}({fields})"

    def __getnewargs__(self) -> tuple[int, ...]:
        return tuple(self._asdict().values())
