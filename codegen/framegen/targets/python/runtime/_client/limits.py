"""The limits of what this end sends by default: less than the wire carries, for safety."""

from __future__ import annotations

from operator import index

from .._frame.errors import LimitError
from .exchange import column

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import TypeAlias

    from .._frame.message import Message

Bounds: TypeAlias = tuple[int, int]


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

    def chosen(self, bounds: Bounds | None) -> Bounds | None:
        """Return the limits given as an argument. Raises ValueError for an impossible pair."""
        if bounds is None:
            return None
        if not self.fields:
            raise ValueError(f"limits is {bounds!r}, and nothing that is sent here has limits")
        try:
            low, high = map(index, bounds)
        except (TypeError, ValueError):
            low, high = 1, 0
        if low > high:
            raise ValueError(
                f"limits is {bounds!r}, and must be the lowest and the highest value that may be "
                f"sent, such as {self.usual}, or None for any"
            )
        return low, high

    def check(self, message: Message, bounds: Bounds | None) -> None:
        """Raise LimitError for a value of a message outside `bounds`; None allows all."""
        if bounds is None:
            return
        low, high = bounds
        for path in self.fields.get(type(message), ()):
            values = column(message, path)
            place = next((at for at, each in enumerate(values) if not low <= each <= high), None)
            if place is not None:
                at = placed(message, path, place)
                raise LimitError(at, values[place], bounds, self.way_out(values[place]))

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


def placed(message: Message, path: str, place: int) -> str:
    """Return the place of a value in a message: `items[1].level`, or just `level`."""
    name, dot, inner = path.partition(".")
    listed = isinstance(getattr(message, name), tuple)
    return f"{name}[{place}]{dot}{inner}" if listed else name


def nearest(value: int, bounds: Bounds) -> int:
    """Return the value within `bounds` that is nearest to `value`."""
    low, high = bounds
    return min(max(value, low), high)
