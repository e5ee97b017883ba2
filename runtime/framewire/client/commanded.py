"""Who was commanded to move, and has not been released since."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..frame.message import Message
    from .pose import Pose


class Commanded:
    """Those that this end has commanded: whether the last command moved or released each."""

    __slots__ = ("_moved", "_pose")

    def __init__(self, pose: Pose | None) -> None:
        self._pose = pose
        self._moved: dict[int, bool] = {}

    def sent(self, message: Message) -> None:
        """Record a message that was sent. Only those of the pose tell whom they move."""
        pose = self._pose
        if pose is None:
            return
        if isinstance(message, pose.move):
            for number, _ in getattr(message, pose.moved):
                self._moved[number] = True
        elif isinstance(message, pose.release):
            self._moved |= dict.fromkeys(getattr(message, pose.requested), False)

    def still(self, ids: Iterable[int] = ()) -> tuple[int, ...]:
        """Return the numbers of those that were moved, and `ids`, without those released since."""
        numbers = dict.fromkeys((*ids, *self._moved))
        return tuple(each for each in numbers if self._moved.get(each, True))
