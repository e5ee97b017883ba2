"""Fields that may be absent: the last of a message, each with all that stand behind it."""

from __future__ import annotations

from .field import Field

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, TypeVar

    Value = TypeVar("Value")


class Optional(Field["Value | None"]):
    """A number that is None where the frame ends before it; `tail` bytes stand behind the fields.

    `number` is the field that it is where it is there.
    """

    __slots__ = ("number", "tail")

    def __init__(self, number: Field[Value], *, tail: int = 0) -> None:
        self.number: Any = number
        self.tail = tail

    def reader(self) -> Callable[[Any], Value | None]:
        """Return a function that reads it from the bytes of a message; None where it is absent."""
        self.number.name, self.number.owner = self.name, self.owner
        read = self.number.reader()
        least = self.at + self.number.struct.size + self.tail
        return lambda message: read(message) if len(message._frame) >= least else None

    @property
    def there(self) -> Field[Any]:
        """The field that it is where it is not absent."""
        number: Field[Any] = self.number
        return number

    @property
    def at(self) -> int:
        """The offset of its first byte, where it is there."""
        at: int = self.number.at
        return at

    @property
    def unit(self) -> str:
        """Its unit, if it has one."""
        unit: str = self.number.unit
        return unit

    @property
    def names(self) -> dict[str, int]:
        """The names of its values."""
        names: dict[str, int] = self.number.names
        return names
