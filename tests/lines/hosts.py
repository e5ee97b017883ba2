"""A host for the tests: it writes messages, and reads what comes back."""

import time
from collections.abc import Callable

from busservo import Direction, Message, Noise, StreamDecoder
from busservo_simulator import VirtualController
from framewire.line.transport import Transport

from tests.timeouts import GENEROUS

# How long silence lasts until it is believed, by the clock of a board whose time nobody waits for.
SILENCE = 5.0


class Host:
    """The other end of a board's line."""

    def __init__(
        self,
        transport: Transport,
        now: Callable[[], float] = time.monotonic,
        timeout: float = GENEROUS,
    ) -> None:
        self.transport = transport
        self.timeout = timeout
        self.bytes = b""
        self.received: list[Message | Noise] = []
        self._now = now
        self._decoder = StreamDecoder(Direction.CONTROLLER_TO_HOST)

    def say(self, *messages: Message) -> None:
        """Write messages, one write each."""
        for message in messages:
            self.transport.write(message.encode())

    def ask(self, message: Message) -> Message | None:
        """Write a message, and return the next that comes."""
        self.say(message)
        return self.receive()

    def receive(self, timeout: float | None = None) -> Message | None:
        """Return the next message; None if none comes in time."""
        end = self._now() + (self.timeout if timeout is None else timeout)
        while True:
            for event in self.received:
                if isinstance(event, Message):
                    self.received.remove(event)
                    return event
            left = end - self._now()
            if left <= 0:
                return None
            self._listen(left)

    def collect(self, count: int) -> bytes:
        """Return the next `count` bytes, or as many as come in time."""
        end = self._now() + self.timeout
        data = b""
        while len(data) < count and (left := end - self._now()) > 0:
            data += self.transport.read(left)
        return data

    def _listen(self, timeout: float) -> None:
        data = self.transport.read(timeout)
        self.bytes += data
        self.received += self._decoder.feed(data)

    def hang_up(self) -> None:
        """Close the port. pyserial sleeps after it has closed a socket, so that is done here."""
        port = getattr(self.transport, "_port", None)
        behind = getattr(port, "_socket", None)
        if port is not None and behind is not None:
            behind.close()
            port.is_open = False
        self.transport.close()

    def noise(self) -> list[bytes]:
        """Return the noise so far."""
        return [event.data for event in self.received if isinstance(event, Noise)]


def host_of(board: VirtualController) -> Host:
    """Return a host at the board's own clock, in the same process."""
    return Host(board.transport, board.clock.now, SILENCE)
