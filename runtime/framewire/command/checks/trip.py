"""A question, and all that came after it, with times: echo, replies, reports and noise."""

from __future__ import annotations

from ...codec.noise import Noise
from .heard import Heard

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...client.library import Library
    from ...frame.message import Message
    from .heard import Pieces


class Trip:
    """A round trip: what came after a question sent at `sent_at`, in pieces, each with its time.

    With `local_echo`, the question is expected back, even where the device may send the same.
    """

    def __init__(
        self,
        library: Library,
        question: Message,
        sent_at: float,
        pieces: Pieces,
        *,
        local_echo: bool = False,
    ) -> None:
        self._library = library
        self.question = question
        self._local_echo = local_echo
        self.sent_at = sent_at
        self.received = b"".join(data for _, data in pieces)
        # Where the question itself came back: an adapter echoes what passes on its one wire.
        self.echo = self._find_echo()
        self.heard = Heard(library.codec, pieces, self.echo)
        self.events = self.heard.events

    @property
    def echoed(self) -> bool:
        """Whether the question itself came back."""
        return bool(self.echo)

    @property
    def replies(self) -> list[tuple[float, Message]]:
        """The replies to the question, each with the seconds that it took to be complete."""
        exchange = self._library.exchanges[type(self.question)]
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
        codec = self._library.codec
        sent = codec.decoder(codec.received).feed(frame)
        if not self._local_echo and any(not isinstance(each, Noise) for each in sent):
            return range(0)  # the device may have sent this
        at = self.received.find(frame)
        return range(0) if at < 0 else range(at, at + len(frame))
