"""What holds those that are there where they are, whatever the others do."""

from __future__ import annotations

from ..frame.errors import LimitError
from .long_question import parts_of
from .pose import HOLD_MS

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from ..frame.message import Message
    from .limits import Allowed
    from .long_question import Exchanges
    from .pose import Pose


class Holding:
    """The questions for positions and the commands of just these, for whoever sends them.

    `questions` are to be asked, and each reply given to `take`; then `commands` are to be sent.
    `held` has the numbers of those whose command was sent, and `left` of each other why not.
    """

    __slots__ = ("_limits", "_pose", "_targets", "held", "left", "questions")

    def __init__(
        self, pose: Pose, exchanges: Exchanges, ids: Iterable[int], limits: Allowed
    ) -> None:
        self._pose = pose
        self._limits = limits
        self._targets: list[tuple[int, int]] = []
        numbers = tuple(dict.fromkeys(ids))
        asked = [each for each in numbers if each in pose.ids]
        self.questions = parts_of(exchanges, pose.read, asked) if asked else []
        self.held: list[int] = []
        low, high = pose.ids[0], pose.ids[-1]
        self.left = {
            each: "no answer" if each in pose.ids else f"it is outside {low}..{high}"
            for each in numbers
        }

    def take(self, reply: Message) -> None:
        """Take in the positions of a reply, save those that are outside the limits."""
        for each in self._pose.there([reply]):
            number = each[0]
            try:
                self._targets += self._pose.targets_of([each], self._limits)
            except LimitError as error:
                low, high = error.limits
                self.left[number] = f"{error.value} is outside the limits {low}..{high}"

    def commands(self) -> Iterator[Message]:
        """Yield the motions to where they are, as many as it takes; each holds once it is sent."""
        for at in range(0, len(self._targets), self._pose.room):
            part = self._targets[at : at + self._pose.room]
            yield self._pose.motion(part, HOLD_MS)
            for number, _ in part:
                self.held.append(number)
                self.left.pop(number, None)
