"""Events of what a device sends, decoded by the reference as it arrives, each with its time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.stream import ReferenceDecoder

if TYPE_CHECKING:
    from framegen.model.model import Model
    from framegen.model.stream import Event

# A device that sends noise without end: what is decided of it is given up from so many bytes on.
_MOST_HELD = 2048


@dataclass(frozen=True, slots=True)
class Received:
    """An event, and when its last byte arrived."""

    at: float
    event: Event


class Receiver:
    """A decoder for what arrives chunk by chunk; a message is reported as soon as it is whole."""

    def __init__(self, model: Model) -> None:
        self._line = ReferenceDecoder(model, [model.roles.received])
        self._held = b""
        # When each of the bytes held has come.
        self._times: list[float] = []
        # What was sent and has not come back yet, on a line with an echo.
        self._echo = b""

    def expect(self, echo: bytes) -> None:
        """Leave out the next bytes that arrive, where they are these."""
        self._echo = echo

    def feed(self, data: bytes, now: float) -> list[Received]:
        """Take bytes in, and return the events that are decided, up to the last frame."""
        data = self._behind_echo(data)
        self._held += data
        self._times += [now] * len(data)
        events = self._line.decode_so_far(self._held)
        if len(self._held) <= _MOST_HELD:
            # Noise may still grow.
            while events and events[-1].kind == "noise":
                events.pop()
        return self._taken(events)

    def _behind_echo(self, data: bytes) -> bytes:
        """Return what arrives besides the echo. One that is another is left for all to see."""
        size = min(len(data), len(self._echo))
        if data[:size] != self._echo[:size]:
            self._echo = b""
            return data
        self._echo = self._echo[size:]
        return data[size:]

    @property
    def holds_a_frame(self) -> bool:
        """Whether a message is there, and is held as a longer one may begin with it."""
        return bool(self._held) and self._line.weigh(self._held).message is not None

    def flush(self) -> list[Received]:
        """Return the events of the bytes held, now that the line is quiet."""
        return self._taken(self._line.decode(self._held))

    def _taken(self, events: list[Event]) -> list[Received]:
        received = [Received(self._times[each.at + len(each.data) - 1], each) for each in events]
        size = sum(len(event.data) for event in events)
        self._held, self._times = self._held[size:], self._times[size:]
        return received
