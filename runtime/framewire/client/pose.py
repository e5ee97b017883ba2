"""Poses: positions that were read, turned into targets that can be commanded."""

from __future__ import annotations

from collections.abc import Mapping

from ..frame.errors import LimitError
from ..line.link_errors import AbsentError
from .limits import nearest

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import Any

    from ..frame.lists import List
    from ..frame.message import Message
    from ..frame.number import Number
    from .limits import Allowed, Limits

HOLD_MS = 100
"""How long a motion takes, in milliseconds, that only holds what is there."""

# How far outside the limits a position at its stop may be read: this part of their range.
_SLACK = 20


class Pose:
    """How the positions of a protocol are read, commanded and released, and under which names.

    `read`, `move` and `release` are the messages that do so. `requested` is the list of numbers in
    `read` and `release`, `reported` the list of positions in the reply to `read`, each a number and
    a position; `moved` the list in `move`, and `time` the milliseconds that the motion takes.
    `releasing` is the word for letting go.
    `position` is the property that gives a position, below zero included. `ids` are all possible
    numbers, `limits` those of the positions that are commanded.

    In an element of `move`, `item` is the number that says whose position it is and `place` the
    position; `duration` is the milliseconds that a motion may take, and `room` how many elements
    fit.
    """

    __slots__ = (
        "duration",
        "ids",
        "item",
        "limits",
        "move",
        "moved",
        "place",
        "position",
        "read",
        "release",
        "releasing",
        "reported",
        "requested",
        "room",
        "time",
    )

    def __init__(
        self,
        *,
        read: type[Message],
        move: type[Message],
        release: type[Message],
        ids: range,
        requested: str,
        reported: str,
        position: str,
        moved: str,
        time: str,
        releasing: str,
        limits: Limits,
    ) -> None:
        self.read = read
        self.move = move
        self.release = release
        self.ids = ids
        self.requested = requested
        self.reported = reported
        self.position = position
        self.moved = moved
        self.time = time
        self.releasing = releasing
        self.limits = limits
        targets: List[Any] = getattr(move, moved)
        self.item: Number
        self.place: Number
        self.item, self.place = targets.fields
        self.room = targets.most
        self.duration: Number = getattr(move, time)

    @property
    def noun(self) -> str:
        """The name of one of those whose positions these are."""
        return self.item.name.removesuffix("_id").replace("_", " ")

    def motion(self, targets: Iterable[tuple[int, int]], time_ms: int) -> Message:
        """Return the command that moves to these targets. Raises EncodeError."""
        return self.move(**{self.moved: list(targets), self.time: time_ms})

    def letting_go(self, ids: Iterable[int]) -> Message:
        """Return the command that releases these. Raises EncodeError."""
        return self.release(**{self.requested: list(ids)})

    @property
    def releases(self) -> int:
        """How many fit into one such command."""
        listed: List[int] = getattr(self.release, self.requested)
        return listed.most

    def there(self, replies: Iterable[Message]) -> list[Any]:
        """Return the positions in the replies, without those that are reported absent."""
        reported = [each for reply in replies for each in getattr(reply, self.reported)]
        return [each for each in reported if not getattr(each, "absent", False)]

    def present_in(self, replies: Iterable[Message]) -> tuple[int, ...]:
        """Return the numbers of those that are present, in the order of the replies."""
        return tuple(number for number, _ in self.there(replies))

    def targets_of(self, positions: Iterable[Any], limits: Allowed) -> list[tuple[int, int]]:
        """Return the targets that send those which are present to where they were.

        One that is absent is left out. One at its stop may be read a little below zero, or a little
        outside the limits: it is sent to the nearest position inside. Raises LimitError for one
        that is further out, and would be sent somewhere else.
        """
        targets: list[tuple[int, int]] = []
        for at, each in enumerate(positions):
            if getattr(each, "absent", False):
                continue
            number, raw = each
            bounds = self.limits.of(number, limits) or (self.place.low, self.place.high)
            slack = (bounds[1] - bounds[0]) // _SLACK
            below: int = getattr(each, self.position)
            value = below if -slack <= below < 0 else raw
            near = nearest(value, bounds)
            if abs(value - near) > slack:
                path = f"{self.reported}[{at}].{self.place.name}"
                if isinstance(limits, Mapping):
                    raise self.limits.refusal(path, value, bounds, self.item.name, number)
                raise LimitError(path, value, bounds, self.limits.way_out(value, read=True))
            targets.append((number, near))
        return targets

    def held(
        self, exchanged: Sequence[tuple[Message, Message]], limits: Allowed
    ) -> list[tuple[int, int]]:
        """Return the targets that hold everything requested, by the replies.

        Raises AbsentError if one is not there, and LimitError if one is outside the limits.
        """
        requested = [
            number for request, _ in exchanged for number in getattr(request, self.requested)
        ]
        replies = [reply for _, reply in exchanged]
        there = self.there(replies)
        missing = dict.fromkeys(requested).keys() - {number for number, _ in there}
        if missing:
            raise AbsentError(
                self.requested, [each for each in requested if each in missing], replies, there
            )
        return self.targets_of(there, limits)
