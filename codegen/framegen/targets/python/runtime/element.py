"""What the elements of a message's list have in common."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import ClassVar


class Element:
    """A tuple whose parts have names; equal to the plain tuple of the same numbers."""

    __slots__ = ()
    __match_args__: ClassVar[tuple[str, ...]] = ()

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.__match_args__)
        return f"{type(self).__name__}({fields})"

    def __getnewargs__(self) -> tuple[int, ...]:
        return tuple(getattr(self, name) for name in self.__match_args__)
