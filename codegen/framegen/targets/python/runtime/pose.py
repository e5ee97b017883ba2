"""Positions that were read, made into what can be commanded: who is there, and where to."""

from __future__ import annotations

from .limits import nearest
from .link_errors import AbsentError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import Any

    from .fields import Number
    from .limits import Bounds
    from .message import Message

HOLD_MS = 100
"""How long a motion takes, in milliseconds, that only holds what is there."""


class Pose:
    """How the positions of a protocol are read, commanded and let go, and under which names.

    `read`, `move` and `release` are the messages that do so. `asked` is the list of numbers that
    `read` and `release` are given, `told` the list of positions that answers `read`, each a number
    and a position; `moved` the list that `move` is given, and `time` the milliseconds that it may
    take. `position` is the property that tells a position, below zero included. `ids` are all
    numbers that there can be; `hold`, `present` and `targets` are methods of a controller.
    """

    __slots__ = (
        "asked",
        "hold",
        "ids",
        "move",
        "moved",
        "position",
        "present",
        "read",
        "release",
        "targets",
        "time",
        "told",
    )

    def __init__(
        self,
        *,
        read: type[Message],
        move: type[Message],
        release: type[Message],
        ids: range,
        asked: str,
        told: str,
        position: str,
        moved: str,
        time: str,
        hold: str,
        present: str,
        targets: str,
    ) -> None:
        self.read = read
        self.move = move
        self.release = release
        self.ids = ids
        self.asked = asked
        self.told = told
        self.position = position
        self.moved = moved
        self.time = time
        self.hold = hold
        self.present = present
        self.targets = targets

    @property
    def noun(self) -> str:
        """What one of those is called whose positions these are."""
        return self.item.name.removesuffix("_id").replace("_", " ")

    @property
    def item(self) -> Number:
        """The number that says whose a position is."""
        return self._fields[0]

    @property
    def place(self) -> Number:
        """A position that can be commanded."""
        return self._fields[1]

    @property
    def duration(self) -> Number:
        """The milliseconds that a motion may take."""
        return next(each for each in self.move.SHAPE.numbers if each.name == self.time)

    @property
    def room(self) -> int:
        """How many one motion can move."""
        items = self.move.SHAPE.items
        return items.counts[-1] if items is not None else 0

    @property
    def _fields(self) -> tuple[Number, ...]:
        items = self.move.SHAPE.items
        return items.fields if items is not None else ()

    def motion(self, targets: Iterable[tuple[int, int]], time_ms: int) -> Message:
        """The command that moves to these targets. Raises EncodeError."""
        return self.move(**{self.moved: list(targets), self.time: time_ms})

    def letting_go(self, ids: Iterable[int]) -> Message:
        """The command that lets go of these. Raises EncodeError."""
        return self.release(**{self.asked: list(ids)})

    def there(self, replies: Iterable[Message]) -> list[Any]:
        """The positions that replies tell, without those that are told to be absent."""
        told = [each for reply in replies for each in getattr(reply, self.told)]
        return [each for each in told if not getattr(each, "absent", False)]

    def present_in(self, replies: Iterable[Message]) -> tuple[int, ...]:
        """The numbers of those that are there, in the order of the replies."""
        return tuple(number for number, _ in self.there(replies))

    def targets_of(self, positions: Iterable[Any], limits: Bounds | None) -> list[tuple[int, int]]:
        """Where to send those that are there, to be where they were: as near as limits allow.

        One that is absent is left out. One that is below zero, which no command can say, is sent to
        the lowest position there is.
        """
        bounds = (self.place.low, self.place.high) if limits is None else limits
        return [
            (each[0], nearest(getattr(each, self.position), bounds))
            for each in positions
            if not getattr(each, "absent", False)
        ]

    def held(
        self, exchanged: Sequence[tuple[Message, Message]], limits: Bounds | None
    ) -> list[tuple[int, int]]:
        """What holds all that was asked about, by the replies to it. Raises AbsentError."""
        asked = [number for request, _ in exchanged for number in getattr(request, self.asked)]
        replies = [reply for _, reply in exchanged]
        there = self.there(replies)
        missing = dict.fromkeys(asked).keys() - {number for number, _ in there}
        if missing:
            raise AbsentError(
                self.asked, [each for each in asked if each in missing], replies, there
            )
        return self.targets_of(there, limits)
