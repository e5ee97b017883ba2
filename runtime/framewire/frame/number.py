"""Fields that are whole numbers: their place, their range, how they are read and checked.

A message that is given good values never runs these checks: they explain what is wrong with bad
ones, and they turn other kinds of whole numbers (such as NumPy's) into an int.
"""

from __future__ import annotations

from operator import index, itemgetter
from struct import Struct

from .errors import EncodeError
from .field import Field

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from typing import Any, ClassVar

    from .field import Place

# How `struct` writes the order of a single byte, which has none: as that of whatever machine.
ANY_ORDER = "="


class Number(Field["int"]):
    """A whole number at its place: the offset of its first byte, in the frame or in its element.

    From `low` to `high`, if its type would hold more, or one of `others`; in a `unit`, if it has
    one. `names` maps the names of values to these values, such as `{"off": 0}`, and `bits` those of
    bits to a number that has just these set.
    """

    __slots__ = ("at", "bits", "high", "low", "names", "others", "unit")

    plain: ClassVar[bool] = True
    code: ClassVar[str]
    """Its letter in `struct`."""
    struct: ClassVar[Struct]
    """What packs and unpacks it."""
    lowest: ClassVar[int]
    """The lowest value that its type holds."""
    highest: ClassVar[int]
    """The highest value that its type holds."""

    def __init__(
        self,
        at: int = 0,
        *,
        low: int | None = None,
        high: int | None = None,
        unit: str = "",
        names: Mapping[str, int] | None = None,
        bits: Mapping[str, int] | None = None,
        others: tuple[int, ...] = (),
    ) -> None:
        self.at = at
        self.low = self.lowest if low is None else low
        self.high = self.highest if high is None else high
        self.unit = unit
        self.names: Mapping[str, int] = names or {}
        self.bits: Mapping[str, int] = bits or {}
        self.others = others

    def __init_subclass__(cls, *, code: str, order: str) -> None:
        super().__init_subclass__()
        cls.code, cls.struct = code, Struct(order + code)
        values = 1 << 8 * cls.struct.size
        cls.lowest = -values // 2 if code.islower() else 0
        cls.highest = cls.lowest + values - 1

    @property
    def narrowed(self) -> bool:
        """Whether its type holds more than its range."""
        return self.low > self.lowest or self.high < self.highest

    @property
    def places(self) -> Sequence[Place]:
        """What can be wrong in it: all of it, where its type holds more than its range."""
        unpack, holds = self.struct.unpack, self.holds

        def wrong(data: bytes) -> int | None:
            return None if holds(unpack(data)[0]) else 0

        return [(self.at, self.at + self.struct.size, wrong)] if self.narrowed else ()

    def explained(self, data: bytes, _at: int, /) -> str:
        """Return what is wrong with its bytes, at an offset in these."""
        return f"is {self.struct.unpack(data)[0]}, outside {self.low}..{self.high}"

    def holds(self, number: int) -> bool:
        """Return whether a frame may hold this number."""
        return self.low <= number <= self.high or number in self.others

    def reader(self) -> Callable[[Any], int]:
        """Return a function that reads it from the bytes of a message, or from an element."""
        if issubclass(self.owner, tuple):
            return itemgetter(vars(self.owner)["__match_args__"].index(self.name))
        at = self.at
        if self.code == "B":
            return lambda message: message._frame[at]
        unpack = self.struct.unpack_from
        return lambda message: unpack(message._frame, at)[0]

    def checked(self, value: Any, path: str) -> int:
        """Return `value` as an int. Raises EncodeError if it is none, or outside the range."""
        # NumPy's truth values are numbers to its older versions, so their type is looked at.
        if isinstance(value, bool) or str(getattr(value, "dtype", "")) == "bool":
            problem = f"{shown(value)} is a truth value, not a whole number"
            raise EncodeError(path, value, problem)
        try:
            number = index(value)
        except TypeError:
            problem = f"{shown(value)} is not a whole number, but {kind_of(value)}"
            raise EncodeError(path, value, problem) from None
        if not self.holds(number):
            raise EncodeError(path, value, f"{shown(number)} is outside {self.low}..{self.high}")
        return number


class U8(Number, code="B", order=ANY_ORDER):
    """A byte."""

    __slots__ = ()


class I8(Number, code="b", order=ANY_ORDER):
    """A signed number of one byte, in two's complement."""

    __slots__ = ()


def order_of(pieces: Iterable[Any]) -> str:
    """Return the byte order of most of these, as `struct` writes it; any where none has one."""
    orders = [each[0] for each in map(notation_of, pieces) if each]
    return max((each for each in orders if each != ANY_ORDER), key=orders.count, default=ANY_ORDER)


def notation_of(piece: Any) -> str:
    """Return the order and the letter of a number in `struct`; empty where it knows none."""
    notation: str = getattr(getattr(piece, "struct", None), "format", "")
    return notation


def shown(value: object) -> str:
    """Return `value` for an error message, shortened if it would flood it."""
    if isinstance(value, int) and value.bit_length() > 128:
        return f"an integer of {value.bit_length()} bits"
    try:
        text = repr(value)
    except ValueError:  # Python refuses to write out integers of thousands of digits
        return kind_of(value)
    return text if len(text) <= 60 else text[:57] + "..."


def kind_of(value: object) -> str:
    """Return what a value is, for an error message: `a str`, `nothing`."""
    name = type(value).__name__
    return "nothing" if value is None else f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def set_bits(value: int, bits: Mapping[str, int]) -> list[str]:
    """Return the named bits that are set in a value, and what they are together: `code 5`."""
    found = {name: (value & mask) // (mask & -mask) for name, mask in bits.items() if value & mask}
    return [name if bits[name].bit_count() == 1 else f"{name} {found[name]}" for name in found]
