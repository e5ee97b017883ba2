"""Decode a stream of bytes, of which any part may be noise, into messages and noise.

A header is believed only while everything after it agrees, in the end its checksum if there is one.
A header that is refused costs one byte, never the length that it claimed, so that noise cannot
swallow the frame behind it.

There are two lanes: frames back to back, here, by look-ups alone; and the way through noise.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..frame.bytes_like import as_bytes
from ..frame.direction import Direction
from ..frame.message import Message
from ..frame.table import is_certain, measured
from .counters import Counters
from .noise_lane import NoiseLane
from .protocol_codec import ProtocolCodec

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from ..frame.typing_later import typing

_new = object.__new__


class StreamDecoder:
    """A decoder that turns bytes, fed in pieces of any size, into messages and noise.

    Nothing is lost: the bytes of all messages and all noise, in order, are the bytes that were fed.
    How they were cut makes no difference, save that one piece of noise may come as several. It
    never raises on input, and never holds more than the largest legal frame.

    `direction` says who sends: for a client that of the device's messages, and None for a line on
    which both are received. A frame that is legal in both is read in the one declared first. A
    frame of more than `max_frame` bytes is refused by its length, so that no more than that is ever
    held.
    """

    __slots__ = (
        "_held",
        "_look_up",
        "_message_bytes",
        "_messages",
        "_noise",
        "_scanned",
        "_table",
        "_wake",
    )

    # Each protocol has its own decoder: a subclass, which knows what its frames are.
    _codec: typing.ClassVar[ProtocolCodec]

    def __init__(self, direction: Direction | None, max_frame: int | None = None) -> None:
        codec = self._codec
        self._table = codec.table_for(direction, max_frame)
        # Bound once: many a chunk holds no more than a frame.
        self._look_up = self._table.get
        self._noise = NoiseLane(self._table, codec.unknown_frame)
        self._held = b""
        # Where the search in the held bytes goes on, and the size below which it need not.
        self._scanned = self._wake = 0
        self._messages = self._message_bytes = 0

    @property
    def pending(self) -> int:
        """How many bytes are held back, because a frame may have begun."""
        return len(self._held)

    @property
    def held(self) -> bytes:
        """The bytes that are held back."""
        return self._held

    @property
    def scanned(self) -> int:
        """How many of those begin no message, whatever comes behind them."""
        return self._scanned

    @property
    def missing(self) -> int:
        """How many bytes must come, at the least, before the next event."""
        return max(1, self._wake - len(self._held))

    @property
    def undecided(self) -> tuple[Message, Sequence[type[Message] | None]] | None:
        """The message that is held, and those of which it may be the beginning; None if none is.

        None among those stands for a frame of unknown command.
        """
        held, table = self._held, self._table
        message = table.find(held) if held and not self._scanned else None
        return None if message is None else (message, table.awaited(held))

    @property
    def counters(self) -> Counters:
        """What has been seen so far."""
        emitted = self._noise.emitted
        noise, unknown_frames = emitted - self._message_bytes, self._noise.unknown_frames
        return Counters(emitted + len(self._held), self._messages, noise, unknown_frames)

    def __copy__(self) -> typing.Self:
        other = _new(type(self))
        for name in StreamDecoder.__slots__:
            setattr(other, name, getattr(self, name))
        other._noise = self._noise.copy()
        return other

    # The events are those of a protocol, whose own class says which messages they may be.
    def feed(self, data: bytes | bytearray | memoryview) -> list[typing.Any]:
        """Take in bytes, and return the events that are certain now. b"" is no sign of silence."""
        held = self._held + (data if type(data) is bytes else as_bytes(data))
        if len(held) < self._wake:
            self._held = held
            return []
        table = self._table
        if len(held) <= table.remembered:
            wake = table.waits.get(held)
            if wake is not None:
                self._held, self._wake = held, wake
                return []
        return self._read(held, quiet=False)

    def flush(self) -> list[typing.Any]:
        """Decode the bytes held back, as the line is quiet: they are no frame, but may hide one."""
        events = self._read(self._held, quiet=True)
        self._noise.begin_anew(self._noise.emitted)
        return events

    def _read(self, data: bytes, *, quiet: bool) -> list[typing.Any]:
        """Return the events that are certain, and keep the rest of the bytes."""
        events: list[typing.Any] = []
        table, noise = self._table, self._noise
        head_size, total = table.head_size, table.total
        base, size, at = noise.emitted, len(data), self._scanned
        # Where a search goes on, no frame can begin before it has ended; and what has been tested
        # once is left to it, since it sums that up once for all.
        look_up = _search if at or noise.summed > base else self._look_up
        entry = look_up(data[:head_size])
        begun, before = at, 0
        while True:
            while entry is not None:
                length, count_at, count_end, count, kind, holds, other = entry
                if count and data[at + count_at : at + count_end] != count:
                    entry = other or measured(entry, data, at)
                    continue
                end = at + length
                if end > size:
                    break
                frame = data[at:end]
                if (total is not None and sum(frame) & 0xFF != total) or (
                    holds is not None and not holds(frame)
                ):
                    noise.summed = max(noise.summed, base + end)
                    look_up, entry = _search, other
                    continue
                message = _new(kind)
                message._frame = frame
                events.append(message)
                at = end
                entry = look_up(data[at : at + head_size])
            if at > begun:
                self._messages += len(events) - before
                self._message_bytes += at - begun
                noise.begin_anew(base + at)
                if at == size:
                    self._hold(data, at, at, at)
                    return events
            # What else may be wrong with a frame that is not whole yet is seen by the search.
            if entry is not None and not quiet and (entry[5] is None or is_certain(entry[4])):
                self._hold(data, at, at, at + entry[0])
                return events
            found = noise.search(events, data, base, at, quiet=quiet)
            begun, before, at = noise.emitted - base, len(events), noise.at - base
            if found is None:
                self._hold(data, begun, at, noise.wake - base)
                return events
            # It has been proven: who tested it again, and differed, would search for ever.
            end = at + found[0]
            message = _new(found[1])
            message._frame = data[at:end]
            events.append(message)
            at = end
            look_up = self._look_up if base + at >= noise.summed else _search
            entry = look_up(data[at : at + head_size])

    def _hold(self, data: bytes, start: int, scanned: int, wake: int) -> None:
        """Keep the bytes from `start` on, which allow no event before `wake` bytes are here."""
        self._held = held = data[start:]
        self._scanned, self._wake = scanned - start, wake - start
        table = self._table
        if 0 < len(held) <= table.remembered and scanned == start:
            table.wait(held, self._wake)


def _search(_head: bytes) -> None:
    """Look no head up: what begins there is left to the search."""
