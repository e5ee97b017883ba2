"""One event of a recording: what it was, who sent it, when, and where it stands."""

from __future__ import annotations

from ..codec.noise import Noise
from ..frame.direction import Direction
from ..frame.message import Message

TYPE_CHECKING = False
if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from ..frame.typing_later import typing


class RecordingError(ValueError):
    """A recording that makes no sense; the text says in which line, and why."""


class Entry:
    """One message or one piece of noise of a recording.

    `time` is seconds from the beginning of the recording, and `began` when that was, in seconds
    since 1970; None if it does not say. `sender` is the name of the end that has sent it, None if
    it is unknown, and `direction` the way that it went, None if that is unknown. `line` is the
    number of its line, None for input without lines, and `offset` counts the bytes of all events
    before it.
    """

    __slots__ = ("began", "direction", "event", "line", "offset", "sender", "time")

    def __init__(
        self,
        event: typing.Any,
        sender: str | None,
        offset: int,
        *,
        line: int | None = None,
        time: float | None = None,
        began: float | None = None,
        direction: Direction | None = None,
    ) -> None:
        if direction is None and sender is not None and not isinstance(event, Noise):
            # Of noise, nothing says where it went.
            direction = event.DIRECTION
        self.event: Message | Noise = event
        self.sender = sender
        self.offset = offset
        self.line = line
        self.time = time
        self.began = began
        self.direction: Direction | None = direction

    @property
    def place(self) -> str:
        """Where it stands, for people: `line 3`, or `byte 40`."""
        return f"byte {self.offset}" if self.line is None else f"line {self.line}"

    def __repr__(self) -> str:
        return f"Entry({self.place}, time={self.time}, sender={self.sender!r}, {self.event!r})"
