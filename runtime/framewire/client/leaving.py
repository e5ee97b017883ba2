"""What a client does with what it has moved, as it is closed: hold it, or let go of it."""

from __future__ import annotations

from ..frame.errors import ProtocolError
from ..line.link_errors import NotHeldError, TransportError
from ..line.transport import Transport
from .base_client import BaseClient
from .holding import Holding

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    import typing_extensions as typing

    from ..frame.message import Message
    from .base_client import Steps
    from .pose import Pose
    from .request import Request
else:
    from ..frame.typing_later import typing

# How long it may take in all, however long the reply timeout: nobody waits longer to get out.
EXIT_TIMEOUT = 2.0
# How often a question is repeated at least: no later call can do so.
_RETRIES = 2
_HOLD = "hold"
_LATE = "there was no time"


class LeavingClient(BaseClient):
    """A client that can hold what it has moved, or let go of it, before its line is closed."""

    def __init__(
        self, transport: Transport, *, on_exit: str | None, **settings: typing.Any
    ) -> None:
        self._on_exit = _chosen(on_exit, self._library.pose)
        # Those that it is about; of these, until somebody is told, those that were not reached, and
        # why; and the error behind that.
        self._leaving: tuple[int, ...] = ()
        self._left: dict[int, str] = {}
        self._cause: Exception | None = None
        self._leave_by = 0.0
        super().__init__(transport, **settings)

    def _to_leave(self) -> tuple[int, ...]:
        """Return the numbers of those that are to be held or released as it is closed."""
        return () if self._on_exit is None else self._session.commanded.still(self._ids)

    def _leave(self) -> Steps[None]:
        """Hold them, or let go of them. By now, nobody else can send anything any more."""
        self._leaving = self._to_leave()
        pose = self._library.pose
        if pose is None or not self._leaving:
            return
        self._leave_by = self._clock() + EXIT_TIMEOUT
        try:
            if self._on_exit == _HOLD:
                commands = yield from self._holds(pose)
            else:
                commands = self._releases(pose)
            for command in commands:
                yield from self._by_then(command)
        except TimeoutError:
            self._left = dict.fromkeys(self._left, _LATE)
        except TransportError as error:
            self._lose(error, self._left)

    def _holds(self, pose: Pose) -> Steps[Iterator[Message]]:
        """Ask where they are; return the commands of that, which take out whom they hold.

        What is not answered keeps none of the others from being held.
        """
        holding = Holding(pose, self._library.exchanges, self._leaving, self._limits)
        self._left = holding.left
        for question in holding.questions:
            try:
                request = yield from self._by_then(question)
                holding.take(self._good_reply(request))
            except TransportError:
                raise
            except ProtocolError as error:
                self._cause = error
        return holding.commands()

    def _releases(self, pose: Pose) -> Iterator[Message]:
        """Yield the commands that let go of them, and take out whom each has released."""
        left = self._left = dict.fromkeys(self._leaving, _LATE)
        for at in range(0, len(self._leaving), pose.releases):
            part = self._leaving[at : at + pose.releases]
            yield pose.letting_go(part)
            for number in part:
                del left[number]

    def _by_then(self, message: Message) -> Steps[Request]:
        """Send a message, and wait until it is done. Raises TimeoutError if the time is over."""
        if self._failure is not None:
            raise self._failure.again()
        request = self._session.submit(message, retries=max(self._retries, _RETRIES))
        request.notify = self._wake
        while not request.done:
            if self._clock() >= self._leave_by:
                self._session.cancel(request)
                raise TimeoutError
            yield self._leave_by
        return self._ended(request)

    def _lose(self, error: TransportError, left: Iterable[int]) -> None:
        """Record whom nothing has reached, because the line was lost."""
        self._left = dict.fromkeys(left, str(error))
        self._cause = error

    def _hurry(self) -> None:
        """Give up what is not done yet."""
        self._leave_by = float("-inf")
        self._wake()

    def _tell_left(self, under_way: BaseException | None) -> None:
        """Raise the error that names those that were not reached, once, if there are any.

        An exception that is under way goes on instead, with a note.
        """
        left, self._left = self._left, {}
        pose = self._library.pose
        if pose is None or not left:
            return
        done = "held" if self._on_exit == _HOLD else "released"
        error = NotHeldError(f"{pose.noun}s not {done}", left)
        if under_way is None:
            raise error from self._cause
        self._library.log().warning("%s: %s", self._name, error)
        if hasattr(under_way, "add_note"):  # as from Python 3.11
            under_way.add_note(str(error))


def _chosen(given: str | None, pose: Pose | None) -> str | None:
    """Return what is done on leaving, as an argument. Raises ValueError for what can be none."""
    if given is None:
        return None
    if pose is None:
        raise ValueError(f"on_exit is {given!r}, and this protocol has no positions to hold")
    if given not in {_HOLD, pose.releasing}:
        choices = f"{_HOLD!r}, {pose.releasing!r} or None"
        raise ValueError(f"on_exit is {given!r}, and must be {choices}")
    return given
