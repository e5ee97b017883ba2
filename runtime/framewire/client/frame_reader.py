"""What arrives, as messages and noise, each with the time when it came."""

from __future__ import annotations

from ..codec.gap import GAP
from ..codec.noise import Noise

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import TypeAlias

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.message import Message

    Events: TypeAlias = Sequence[Message | Noise]


class FrameReader:
    """A decoder that knows what time it is, and so when a line has gone quiet within a frame.

    Bytes of one frame follow each other at once. Where the line is found quiet for longer than GAP
    in the middle of a frame, the rest of that frame is lost; see CarefulDecoder.
    """

    def __init__(self, codec: ProtocolCodec) -> None:
        self._codec = codec
        self._decoder = codec.careful_decoder(codec.received)
        self.received_at = float("-inf")
        # When the message came that the decoder is in doubt of.
        self._doubted_at = float("-inf")
        # Whether what is held is known to be a whole frame, which no silence has to end.
        self.is_whole = False

    @property
    def undecided(self) -> tuple[Message, Sequence[type[Message] | None]] | None:
        """The message that is held, and those of which it may be the beginning; None if none is."""
        return self._decoder.undecided

    @property
    def pending(self) -> int:
        """How many bytes of a frame have come that is not whole yet."""
        return self._decoder.pending

    @property
    def missing(self) -> int:
        """How many bytes must come at the least before anything is whole."""
        return self._decoder.missing

    @property
    def quiet_at(self) -> float | None:
        """When the frame that has begun is given up; None where none has."""
        if not self._decoder.pending:
            return None
        return self.received_at if self.is_whole else self.received_at + GAP

    def read(self, data: bytes, now: float) -> Iterable[tuple[float, Events]]:
        """Take in bytes, and return what is whole; a message that was doubted is older than `now`.

        What came at one time is one list.
        """
        self.received_at = max(self.received_at, now)
        decoder = self._decoder
        doubted, events = decoder.doubted, decoder.feed(data)
        if doubted is None or not events or events[0] is not doubted:
            found: Iterable[tuple[float, Events]] = ((now, events),)
        else:
            found = ((self._doubted_at, events[:1]), (now, events[1:]))
        if decoder.doubted is not doubted:
            self._doubted_at = now
        return found

    def flush(self) -> Events:
        """Give up the frame that has begun; return what it was, and what it was holding back."""
        return self._decoder.flush()

    def look_behind(self) -> Events:
        """Return what a false header is holding back; half a frame is left to come in full."""
        decoder = self._decoder.copy()
        events = decoder.flush()
        if all(isinstance(event, Noise) for event in events):
            return []
        self._decoder = decoder
        return events

    def unless_arriving(self, until: float, longer: float = 0.0) -> float:
        """Return a time that is up; a little later where a frame is just arriving.

        One that may take much `longer` has that time as well, as long as it goes on arriving.
        """
        if not self._decoder.pending:
            return until
        return max(until, min(self.received_at, until + longer) + GAP)

    def restart(self) -> None:
        """Begin anew on another line."""
        self._decoder = self._codec.careful_decoder(self._codec.received)
        self.received_at = float("-inf")
