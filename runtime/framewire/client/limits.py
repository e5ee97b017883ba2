"""The limits of what this end sends by default: less than the wire carries, for safety."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import repeat
from operator import index

from ..frame.errors import LimitError
from .exchange import UNADDRESSED, column

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any, TypeAlias

    from ..frame.message import Message
    from .exchange import Unaddressed

Bounds: TypeAlias = tuple[int, int]
# The same for all, or for each by its number; None for any value.
Allowed: TypeAlias = Bounds | Mapping[int, Bounds | None] | None


class Limits:
    """The limits of a protocol: the usual ones, those of other devices, and the fields they are of.

    `fields` has the paths of the fields (`items.level`) by the message that they are in, `targets`
    is the name of the function that makes targets of positions that were read, or empty. A protocol
    without limits has none of these.
    """

    __slots__ = ("fields", "others", "targets", "usual")

    def __init__(
        self,
        usual: Bounds | None = None,
        *,
        others: Mapping[str, Bounds] | None = None,
        fields: Mapping[type[Message], tuple[str, ...]] | None = None,
        targets: str = "",
    ) -> None:
        self.usual = usual
        self.others: Mapping[str, Bounds] = others or {}
        self.fields: Mapping[type[Message], tuple[str, ...]] = fields or {}
        self.targets = targets

    def chosen(self, given: Allowed | str, *, addressed: bool = False) -> Allowed:
        """Return the limits given as an argument. Raises ValueError for what can be none.

        `addressed` says that messages have the address of a device.
        """
        if given is None:
            return None
        if isinstance(given, str) and given == "usual":
            return self.usual
        if not self.fields:
            raise ValueError(f"limits is {given!r}, and nothing that is sent here has limits")
        if not isinstance(given, Mapping):
            return self._pair("limits", given)
        if not addressed and not any(map(self._has_owners, self.fields)):
            raise ValueError(f"limits is {given!r}, and nothing that has limits here has a number")
        allowed: dict[int, Bounds | None] = {}
        for each, bounds in given.items():
            try:
                number = index(each)
            except TypeError:
                problem = f"limits has {each!r}, and must have numbers, such as {{1: {self.usual}}}"
                raise ValueError(problem) from None
            place = f"limits[{number}]"
            allowed[number] = None if bounds is None else self._pair(place, bounds)
        return allowed

    def _has_owners(self, kind: type[Message]) -> bool:
        name = numbered(kind)
        return any(name not in ("", *path.split(".")) for path in self.fields[kind])

    def _pair(self, place: str, given: Any) -> Bounds:
        try:
            low, high = map(index, given)
        except (TypeError, ValueError):
            low, high = 1, 0
        if low > high:
            raise ValueError(
                f"{place} is {given!r}, and must be the lowest and the highest value that may be "
                f"sent, such as {self.usual}, or None for any"
            )
        return low, high

    def of(self, number: int | None, allowed: Allowed) -> Bounds | None:
        """Return the limits of one, by its number: the usual ones if it is not named."""
        if not isinstance(allowed, Mapping):
            return allowed
        return self.usual if number is None else allowed.get(number, self.usual)

    def check(self, message: Message, allowed: Allowed, address: Unaddressed = UNADDRESSED) -> None:
        """Raise LimitError for a value of a message outside its limits; None allows all.

        `address` says which devices it is for. What is for many is within the limits of each.
        """
        if allowed is None:
            return
        if isinstance(allowed, Mapping):
            self._check_each(message, allowed, address)
            return
        low, high = allowed
        for path in self.fields.get(type(message), ()):
            values = column(message, path)
            place = next((at for at, each in enumerate(values) if not low <= each <= high), None)
            if place is not None:
                at = placed(message, path, place)
                raise LimitError(at, values[place], allowed, self.way_out(values[place]))

    def _check_each(
        self, message: Message, allowed: Mapping[int, Bounds | None], address: Unaddressed
    ) -> None:
        many = bool(address.silence(message))
        for path in self.fields.get(type(message), ()):
            numbers = owners(message, path, address)
            name = address.field or numbered(type(message))
            for place, value in enumerate(column(message, path)):
                for number in (None, *allowed) if many else (next(numbers),):
                    bounds = self.of(number, allowed)
                    if bounds is not None and not bounds[0] <= value <= bounds[1]:
                        at = placed(message, path, place)
                        raise self.refusal(at, value, bounds, name, number)

    def refusal(
        self, path: str, value: int, bounds: Bounds, name: str, number: int | None
    ) -> LimitError:
        """Return the error for a value outside the limits of one, whose number is in a field."""
        if number is None:
            return LimitError(path, value, bounds, self.way_out(value))
        owner = f"{name.removesuffix('_id').replace('_', ' ')} {number}"
        known = {"what is usual": self.usual, **self.others}
        ways = [
            f"limits={{{number}: {other}}} is for {whose}"
            for whose, other in known.items()
            if other is not None and other[0] <= value <= other[1]
        ]
        ways.append(f"limits={{{number}: None}} for any")
        return LimitError(path, value, bounds, ", ".join(ways), owner)

    def way_out(self, value: int, *, read: bool = False) -> str:
        """Return what to do about a refused value; `read` says that it was read from the device."""
        known = {"what is usual": self.usual, **self.others}
        takers = [
            f"limits={bounds} is for {name}"
            for name, bounds in known.items()
            if bounds is not None and bounds[0] <= value <= bounds[1]
        ]
        if takers:
            return f"{', '.join(takers)}, limits=None for any"
        made = f"{self.targets}() makes targets of what was read; "
        return f"{made if self.targets and not read else ''}limits=None sends anything"


def numbered(kind: type[Message]) -> str:
    """Return the field whose number says whose values a message holds: the first of each element.

    Empty for a message that has none, as one of a single field.
    """
    items = kind.SHAPE.items
    if items is not None:
        return "" if items.element is None else items.fields[0].name
    names = kind.__match_args__
    return names[0] if len(names) > 1 else ""


def owners(message: Message, path: str, address: Unaddressed) -> Iterator[int | None]:
    """Yield whose each value of a field is, by number; None for one that is nobody's."""
    number = address.of(message)
    listed, dot, _ = path.partition(".")
    name = numbered(type(message))
    if number is None and name not in ("", *path.split(".")):
        if dot:
            yield from (item[0] for item in getattr(message, listed))
            return
        first = getattr(message, name, None)
        number = first if isinstance(first, int) else None
    yield from repeat(number)


def placed(message: Message, path: str, place: int) -> str:
    """Return the place of a value in a message: `items[1].level`, or just `level`."""
    name, dot, inner = path.partition(".")
    listed = isinstance(getattr(message, name), tuple)
    return f"{name}[{place}]{dot}{inner}" if listed else name


def nearest(value: int, bounds: Bounds) -> int:
    """Return the value within `bounds` that is nearest to `value`."""
    low, high = bounds
    return min(max(value, low), high)
