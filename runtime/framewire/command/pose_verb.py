"""A verb that sends one message about positions: what moves is held, what is there is found."""

from __future__ import annotations

from ..client.long_question import parts_of
from .method_verb import MethodVerb
from .positions import find_present, nobody, stopped_by_hand, the_pose
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Namespace

    from ..client.client import Client
    from ..client.library import Library
    from ..frame.message import Message
    from .limits import Chosen


class PoseVerb(MethodVerb):
    """A verb that reads or commands positions."""

    def __init__(self, message: str, library: Library) -> None:
        super().__init__(message, library)
        self._pose = the_pose(library)

    @property
    def may_be_empty(self) -> bool:
        """Whether its list may be left out: all positions are read then."""
        return self.kind is self._pose.read

    def messages(self, arguments: Namespace) -> list[Message]:
        """Return what to send; nothing where all positions are read."""
        if self.may_be_empty and not getattr(arguments, f"field {self._pose.requested}"):
            ids = arguments.settings.ids
            return parts_of(self._library.exchanges, self.kind, ids) if ids else []
        return super().messages(arguments)

    def without_words(self, controller: Client, /) -> list[Message]:
        """Return the question for the positions of all that answer. Raises UsageError for none."""
        ids = find_present(controller, self._library)
        if not ids:
            raise UsageError(nobody(self._pose))
        return parts_of(self._library.exchanges, self.kind, ids)

    def interrupted(self, controller: Client, message: Message, limits: Chosen, /) -> int:
        """Hold what the message moves; return the exit status."""
        moved = [each[0] for each in getattr(message, self._pose.moved)]
        return stopped_by_hand(controller, self._library, moved, limits)
