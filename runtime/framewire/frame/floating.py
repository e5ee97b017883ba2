"""Fields that are floating-point numbers of IEEE 754."""

from __future__ import annotations

from operator import itemgetter
from struct import Struct

from .errors import EncodeError
from .field import Field
from .number import kind_of, shown

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any, ClassVar

# What JSON has no numbers for, and so is written as text there.
_NOT_IN_JSON = ("nan", "inf", "-inf")
# What `float` accepts, and what is no number all the same.
_NO_NUMBERS = (str, bytes, bytearray)


class Float(Field["float"]):
    """A floating-point number: the offset of its first byte, in the frame or in its element.

    Any, infinities and what is no number (NaN) among them; in a `unit`, if it has one.
    """

    __slots__ = ("at", "unit")

    plain: ClassVar[bool] = True
    code: ClassVar[str]
    """Its letter in `struct`."""
    struct: ClassVar[Struct]
    """What packs and unpacks it."""
    narrowed: ClassVar[bool] = False
    """Whether its type holds more than its range: never."""
    names: ClassVar[Mapping[str, int]] = {}
    """The names of values: it has none."""
    low: ClassVar[float]
    """The lowest value besides infinity."""
    high: ClassVar[float]
    """The highest value besides infinity."""

    def __init__(self, at: int = 0, *, unit: str = "") -> None:
        self.at = at
        self.unit = unit

    def __init_subclass__(cls, *, code: str, order: str) -> None:
        super().__init_subclass__()
        cls.code, cls.struct = code, Struct(order + code)
        single = code == "f"
        cls.high = (2 - 2**-23) * 2.0**127 if single else (2 - 2**-52) * 2.0**1023
        cls.low = -cls.high

    def reader(self) -> Callable[[Any], float]:
        """Return a function that reads it from the bytes of a message, or from an element."""
        if issubclass(self.owner, tuple):
            return itemgetter(vars(self.owner)["__match_args__"].index(self.name))
        at, unpack = self.at, self.struct.unpack_from
        return lambda message: unpack(message._frame, at)[0]

    def checked(self, value: Any, path: str) -> float:
        """Return `value` as a float. Raises EncodeError if it is none, or too large for a frame."""
        if isinstance(value, bool) or str(getattr(value, "dtype", "")) == "bool":
            raise EncodeError(path, value, f"{shown(value)} is a truth value, not a number")
        if isinstance(value, str) and value in _NOT_IN_JSON:
            value = float(value)
        try:
            number = None if isinstance(value, _NO_NUMBERS) else float(value)
            if number is not None:
                self.struct.pack(number)
                return number
        except (TypeError, ValueError):
            pass
        except OverflowError:
            bounds = f"{self.low:.7g}..{self.high:.7g}"
            raise EncodeError(path, value, f"{shown(value)} is outside {bounds}") from None
        raise EncodeError(path, value, f"{shown(value)} is not a number, but {kind_of(value)}")
