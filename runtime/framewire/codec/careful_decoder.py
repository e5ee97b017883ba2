"""A stream decoder that doubts a frame whose last bytes may be the start of another.

Where bytes are lost inside a frame, those of the next one take their place, and the two together
may well look legal. A frame whose last bytes could begin another frame is therefore held, until
the bytes behind it show which of the two it was, or until the line is quiet. No other frame waits.
"""

from __future__ import annotations

from copy import copy

from ..frame.errors import Reason
from .event_bytes import bytes_of
from .noise import Noise

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ..frame.direction import Direction
    from ..frame.message import Message
    from .decoder import StreamDecoder
    from .protocol_codec import ProtocolCodec


class CarefulDecoder:
    """A decoder that turns bytes into messages and noise, and doubts some of the messages.

    It has no clock either: its driver calls `flush` when the line has been quiet.
    """

    __slots__ = (
        "_codec",
        "_decoder",
        "_direction",
        "_doubted",
        "_later",
        "_rival",
        "_rival_at",
        "_rival_events",
    )

    def __init__(self, codec: ProtocolCodec, direction: Direction | None) -> None:
        self._codec = codec
        self._direction = direction
        self._decoder = self._begun()
        # The message that is held, and the bytes that have come since.
        self._doubted: Message | None = None
        self._later = b""
        # The decoder of what may begin inside it, where that begins, and its events so far.
        self._rival = self._decoder
        self._rival_at = 0
        self._rival_events: list[Message | Noise] = []

    @property
    def doubted(self) -> Message | None:
        """The message that is held back, if there is one."""
        return self._doubted

    @property
    def undecided(self) -> tuple[Message, Sequence[type[Message] | None]] | None:
        """The message that is held, and those of which it may be the beginning; None if none is."""
        return None if self._doubted is not None else self._decoder.undecided

    @property
    def pending(self) -> int:
        """How many bytes are held back."""
        if self._doubted is not None:
            return len(self._doubted.encode()) + len(self._later)
        return self._decoder.pending

    @property
    def missing(self) -> int:
        """How many bytes must come, at the least, before the next event."""
        return 1 if self._doubted is not None else self._decoder.missing

    def feed(self, data: bytes) -> Sequence[Message | Noise]:
        """Take in bytes, and return the events that are certain now."""
        doubted = self._doubted
        if doubted is None:
            return self._sifted(self._decoder.feed(data))
        self._later += data
        self._rival_events += self._rival.feed(data)
        if self._next_begins() < len(doubted.encode()):
            return self._refuted(doubted) if self._rival_found_a_message() else []
        # What follows continues no frame: the one that is held was whole.
        later = self._later
        self._believe()
        return [doubted, *self.feed(later)]

    def flush(self) -> Sequence[Message | Noise]:
        """Decode the bytes held back, as the line is quiet: they are no frame, but may hide one.

        A message that is in doubt is one if no byte has come behind it. Otherwise it cannot be
        distinguished from one with a gap, so it is noise.
        """
        doubted = self._doubted
        if doubted is None:
            return self._decoder.flush()
        if self._later:
            self._rival_events += self._rival.flush()
            return self._refuted(doubted)
        self._believe()
        return [doubted]

    def _believe(self) -> None:
        """Release the message that is held, which was whole: what follows it begins anew."""
        self._doubted, self._later = None, b""
        self._decoder = self._begun()

    def _begun(self) -> StreamDecoder:
        """Return a decoder that has seen nothing yet."""
        return self._codec.decoder(self._direction)

    def copy(self) -> CarefulDecoder:
        """Return a copy in the same state."""
        other = CarefulDecoder(self._codec, self._direction)
        other._decoder, other._rival = copy(self._decoder), copy(self._rival)
        other._doubted, other._rival_at = self._doubted, self._rival_at
        other._later, other._rival_events = self._later, [*self._rival_events]
        return other

    def _sifted(self, events: Sequence[Message | Noise]) -> Sequence[Message | Noise]:
        """Return the events up to a message that is in doubt; what follows is decoded again."""
        for number, event in enumerate(events):
            # What its checksum proves was whole, and in most others nothing begins.
            if isinstance(event, Noise) or event.FRAME.checksums or not self._beginnings(event):
                continue
            if not (self._is_torn(event) or self._doubt(event)):
                continue
            rest = b"".join(map(bytes_of, events[number + 1 :])) + self._decoder.held
            found = [] if self._doubted is not None else self._refuted(event)
            return [*events[:number], *found, *(self.feed(rest) if rest else ())]
        return events

    def _is_torn(self, message: Message) -> bool:
        """Return whether a message ends in whole frames, which have filled its gap."""
        for _ in self._rivals(message):
            events = self._rival_events
            if self._rival.undecided is not None:
                events = [*events, *copy(self._rival).flush()]
            if events and not any(isinstance(event, Noise) for event in events):
                return True
        return False

    def _doubt(self, message: Message) -> bool:
        """Hold a message back if a frame may begin in its last bytes."""
        size = len(message.encode())
        if not any(
            not self._rival_found_a_message() and self._next_begins() < size
            for _ in self._rivals(message)
        ):
            return False
        self._doubted, self._later = message, b""
        return True

    def _rivals(self, message: Message) -> Iterator[int]:
        """Decode anew from each place in a message where another may begin, one after the other."""
        frame = message.encode()
        for at in self._beginnings(message):
            self._rival, self._rival_at = self._begun(), at
            self._rival_events = [*self._rival.feed(frame[at:])]
            yield at

    def _rival_found_a_message(self) -> bool:
        return any(not isinstance(event, Noise) for event in self._rival_events)

    def _next_begins(self) -> int:
        """Return the byte of the doubted message at which the next frame begins.

        It may yet prove to begin later, as long as its own decoder has not reported it.
        """
        at = self._rival_at
        for event in self._rival_events:
            if not isinstance(event, Noise):
                return at
            at += len(event.data)
        return at + self._rival.scanned

    def _refuted(self, doubted: Message) -> Sequence[Message | Noise]:
        """Treat a doubted message as the start of one frame, and then another."""
        self._doubted, self._later = None, b""
        self._decoder = self._rival
        torn = Noise(doubted.encode()[: self._rival_at], Reason.TOO_SHORT)
        return [torn, *self._sifted(self._rival_events)]

    def _beginnings(self, message: Message) -> list[int]:
        """Return each place behind a frame's own header where another stands, or may begin."""
        frame, heads = message.encode(), self._codec.heads
        found: list[int] = []
        for header in heads.telling:
            at = frame.find(header, 1)
            while at > 0:
                found.append(at)
                at = frame.find(header, at + 1)
        begun = heads.telling_begun
        if frame.endswith(begun, 1):
            found += [len(frame) - len(each) for each in begun if frame.endswith(each, 1)]
        return sorted(set(found)) if len(found) > 1 else found
