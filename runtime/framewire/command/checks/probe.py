"""An open port, used without a client, which would hide what the checks look for."""

from __future__ import annotations

import math

from ...client.wire_time import WireTime
from ...codec.noise import Noise
from .heard import PAUSE, Heard
from .trip import Trip

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ...client.library import Library
    from ...frame.message import Message
    from ...line.transport import Transport
    from .heard import Pieces, TimedEvent

    # The time, the sender or None for noise, the bytes, and their meaning; without bytes, a note.
    Entry = tuple[float, str | None, bytes, str]

_POLL_INTERVAL = 0.02
# A line that never falls silent is left after so long.
_LONGEST = 1.0


class Probe:
    """A transport at `baud` that is sent questions, with all that passes recorded in `log`.

    `reply_timeout` is how many seconds a device may take for a reply, beyond the time on the wire.
    Raises TransportError.
    """

    def __init__(
        self,
        library: Library,
        transport: Transport,
        *,
        baud: float,
        reply_timeout: float,
        clock: Callable[[], float],
        log: list[Entry],
        local_echo: bool = False,
    ) -> None:
        self.baud = baud
        self.reply_timeout = reply_timeout
        self.wire_time = WireTime(library.link, baud)
        self.largest_frame: int | None = getattr(transport, "largest_frame", None)
        self._library = library
        self._transport = transport
        self._clock = clock
        self._log = log
        self._local_echo = local_echo

    def ask(self, question: Message, *, extra: float = 0.0) -> Trip:
        """Send a question, and wait for a reply, `extra` seconds longer than a program would."""
        frame = question.encode()
        sent_at = self._clock()
        self._log.append((sent_at, question.DIRECTION.sender, frame, repr(question)))
        self._transport.write(frame)
        exchange = self._library.exchanges[type(question)]
        size = len(frame) + exchange.reply_size(question)
        until = sent_at + self.wire_time.seconds(size) + self.reply_timeout + extra

        def made_of(pieces: Pieces) -> Trip:
            return Trip(self._library, question, sent_at, pieces, local_echo=self._local_echo)

        trip = made_of(self._collected(until, lambda got: bool(made_of(got).replies)))
        if trip.echoed:
            echo = f"the question, which came back: {question!r}"
            self._log.append((sent_at, None, frame, echo))
        self._note(trip.events)
        return trip

    def tell(self, command: Message) -> None:
        """Send a command, which is not answered."""
        frame = command.encode()
        self._log.append((self._clock(), command.DIRECTION.sender, frame, repr(command)))
        self._transport.write(frame)

    def listen(self, seconds: float) -> Heard:
        """Return what comes unsolicited in so many seconds, and what follows without a pause."""
        until = self._clock() + seconds
        pieces = self._collected(until, lambda _: False)
        heard = Heard(self._library.codec, pieces)
        self._note(heard.events)
        return heard

    def close(self) -> None:
        """Close the port."""
        self._transport.close()

    def _collected(self, until: float, whole: Callable[[Pieces], bool]) -> Pieces:
        """Return the bytes up to the first pause after `whole` holds, or after `until`."""
        pieces: Pieces = []
        last, ended = -math.inf, False
        while True:
            now = self._clock()
            paused = now - last >= PAUSE
            if (paused and (ended or now >= until)) or now >= until + _LONGEST:
                return pieces
            data = self._transport.read(_POLL_INTERVAL)
            if data:
                last = self._clock()
                pieces.append((last, data))
                ended = whole(pieces)

    def _note(self, events: list[TimedEvent]) -> None:
        for at, event in events:
            if isinstance(event, Noise):
                self._log.append((at, None, event.data, event.reason.value))
            else:
                self._log.append((at, event.DIRECTION.sender, event.encode(), repr(event)))
