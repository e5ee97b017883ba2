"""Fields that are a fixed number of whole numbers, whose bits stand behind each other."""

from __future__ import annotations

from .errors import EncodeError
from .field import Field
from .lists import as_tuple
from .number import Number, shown

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import Any, ClassVar, Literal

    from .field import Place


class Packed(Field["tuple[int, ...]"]):
    """So many numbers of so many `bits` each, at the offset of the first byte in the frame.

    In the order "little", the lowest bit of the first number is the lowest of the first byte; in
    the order "big", its highest bit is the highest of the first byte.
    """

    __slots__ = ("at", "bits_each", "high", "length", "low", "order", "size", "unit")

    names: ClassVar[Mapping[str, int]] = {}
    """The names of values: it has none."""

    def __init__(
        self,
        at: int,
        bits: int,
        length: int,
        order: Literal["little", "big"],
        *,
        low: int = 0,
        high: int | None = None,
        unit: str = "",
    ) -> None:
        self.at = at
        self.bits_each = bits
        self.length = length
        self.size = length * bits // 8
        self.low = low
        self.high = (1 << bits) - 1 if high is None else high
        self.unit = unit
        self.order: Literal["little", "big"] = order

    @property
    def narrowed(self) -> bool:
        """Whether so many bits hold more than its range."""
        return self.low > 0 or self.high < (1 << self.bits_each) - 1

    def reader(self) -> Callable[[Any], tuple[int, ...]]:
        """Return a function that reads them from the bytes of a message."""
        at, end = self.at, self.at + self.size
        return lambda message: self.read(message._frame[at:end])

    def read(self, data: bytes) -> tuple[int, ...]:
        """Return the numbers that these bytes hold."""
        whole, bits, mask = (
            int.from_bytes(data, self.order),
            self.bits_each,
            (1 << self.bits_each) - 1,
        )
        places = range(0, self.length * bits, bits)
        found = [whole >> place & mask for place in places]
        return tuple(found if self.order == "little" else found[::-1])

    def packed(self, values: Any) -> bytes:
        """Return the bytes of these numbers. Raises EncodeError for the first bad one."""
        whole, bits = 0, self.bits_each
        numbers = self.checked(values)
        for number in reversed(numbers) if self.order == "little" else numbers:
            whole = whole << bits | number
        return whole.to_bytes(self.size, self.order)

    def checked(self, values: Any) -> list[int]:
        """Return these numbers as ints. Raises EncodeError for the first bad one."""
        items = as_tuple(values)
        if items is None:
            problem = f"{shown(values)} is not a list of whole numbers"
            raise EncodeError(self.name, values, problem)
        if len(items) != self.length:
            problem = f"{len(items)} numbers, and there are always {self.length}"
            raise EncodeError(self.name, values, problem)
        bound = _Bound(low=self.low, high=self.high)
        return [bound.checked(item, f"{self.name}[{at}]") for at, item in enumerate(items)]

    @property
    def places(self) -> Sequence[Place]:
        """What can be wrong in it: all of it, where so many bits hold more than its range."""
        return [(self.at, self.at + self.size, self.wrong)] if self.narrowed else ()

    def explained(self, data: bytes, _at: int, /) -> str:
        """Return what is wrong with its bytes, at an offset in these."""
        value = next(each for each in self.read(data) if not self.low <= each <= self.high)
        return f"is {value}, outside {self.low}..{self.high}"

    def wrong(self, data: bytes) -> int | None:
        """Return 0 where a number in these bytes is outside the range, otherwise None."""
        good = all(self.low <= number <= self.high for number in self.read(data))
        return None if good else 0


class _Bound(Number, code="Q", order="<"):
    """A number with these bounds, whatever its place."""

    __slots__ = ()
