"""Who was commanded to move, and has not been released since."""

from __future__ import annotations

from .exchanges import POSE

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable

    from .._frame.message import Message


class Commanded:
    """Those that this end has commanded: whether the last command moved or released each."""

    __slots__ = ("_moved",)

    def __init__(self) -> None:
        self._moved: dict[int, bool] = {}

    def sent(self, message: Message) -> None:
        """Record a message that was sent. Only those of the pose tell whom they move."""
        if POSE is None:
            return
        if isinstance(message, POSE.move):
            for number, _ in getattr(message, POSE.moved):
                self._moved[number] = True
        elif isinstance(message, POSE.release):
            self._moved |= dict.fromkeys(getattr(message, POSE.requested), False)

    def still(self, ids: Iterable[int] = ()) -> tuple[int, ...]:
        """Return the numbers of those that were moved, and `ids`, without those released since."""
        numbers = dict.fromkeys((*ids, *self._moved))
        return tuple(each for each in numbers if self._moved.get(each, True))
