"""A question, and all that came after it, with times: echo, replies, reports and noise."""

from __future__ import annotations

from bisect import bisect_left
from itertools import accumulate

from ..._client.exchanges import EXCHANGES
from ..._codec.decoder import StreamDecoder
from ..._codec.event_bytes import bytes_of
from ..._codec.noise import Noise
from ..._frame.direction import RECEIVED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..._frame.message import Message

    # Bytes, and events, each with the time at which they had come.
    Pieces = list[tuple[float, bytes]]
    TimedEvent = tuple[float, Message | Noise]


def timed_events(pieces: Pieces, left_out: range = range(0)) -> list[TimedEvent]:
    """Return the events in bytes that came in pieces, each with the time at which it was complete.

    The bytes in `left_out` are skipped.
    """
    data = b"".join(piece for _, piece in pieces)
    ends = [*accumulate(len(piece) for _, piece in pieces)]
    decoder = StreamDecoder(RECEIVED)
    # All at once, so that consecutive noise is one piece.
    events = decoder.feed(data[: left_out.start] + data[left_out.stop :])
    found: list[TimedEvent] = []
    end = 0
    for event in [*events, *decoder.flush()]:
        end += len(bytes_of(event))
        at = end + len(left_out) * (end > left_out.start)
        found.append((pieces[bisect_left(ends, at)][0], event))
    return found


class Trip:
    """A round trip: what came after a question sent at `sent_at`, in pieces, each with its time.

    With `local_echo`, the question is expected back, even where the device may send the same.
    """

    def __init__(
        self, question: Message, sent_at: float, pieces: Pieces, *, local_echo: bool = False
    ) -> None:
        self.question = question
        self._local_echo = local_echo
        self.sent_at = sent_at
        self.received = b"".join(data for _, data in pieces)
        # Where the question itself came back: an adapter echoes what passes on its one wire.
        self.echo = self._find_echo()
        self.events = timed_events(pieces, self.echo)

    @property
    def echoed(self) -> bool:
        """Whether the question itself came back."""
        return bool(self.echo)

    @property
    def replies(self) -> list[tuple[float, Message]]:
        """The replies to the question, each with the seconds that it took to be complete."""
        exchange = EXCHANGES[type(self.question)]
        return [
            (at - self.sent_at, event)
            for at, event in self.events
            if not isinstance(event, Noise) and exchange.answers(self.question, event)
        ]

    @property
    def noise(self) -> list[Noise]:
        """The noise after the question."""
        return [event for _, event in self.events if isinstance(event, Noise)]

    @property
    def others(self) -> list[Message]:
        """The messages that do not answer the question."""
        replies = {id(reply) for _, reply in self.replies}
        return [
            event
            for _, event in self.events
            if not isinstance(event, Noise) and id(event) not in replies
        ]

    def _find_echo(self) -> range:
        frame = self.question.encode()
        sent = StreamDecoder(RECEIVED).feed(frame)
        if not self._local_echo and any(not isinstance(each, Noise) for each in sent):
            return range(0)  # the device may have sent this
        at = self.received.find(frame)
        return range(0) if at < 0 else range(at, at + len(frame))
