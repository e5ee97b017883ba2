"""Decode a stream of bytes, of which any part may be noise, into messages and noise.

There is no checksum, so a header is believed only while everything after it agrees: a length that
the command can have, a count that follows from the length. A header that is refused costs one byte,
never the length that it claimed, so that noise cannot swallow the frame behind it.

There are two lanes: frames back to back, here, by look-ups alone; and the way through noise.
"""

from __future__ import annotations

from .._frame.bytes_like import as_bytes
from .._frame.direction import Direction
from .._frame.protocol import BODY_AT
from ..messages import Decoded
from .codec import table_for
from .counters import Counters
from .noise import Noise
from .noise_lane import NoiseLane

TYPE_CHECKING = False
if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from .._frame.typing_later import typing

Event: typing.TypeAlias = Decoded | Noise
"""Whatever a stream decoder gives: a message or a piece of noise."""

_new = object.__new__

# Beginnings of frames that are remembered, with the size they wait for, have at most this size.
_REMEMBERED = BODY_AT + 1


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

    __slots__ = ("_held", "_message_bytes", "_messages", "_noise", "_scanned", "_table", "_wake")

    def __init__(self, direction: Direction | None, max_frame: int | None = None) -> None:
        self._table = table_for(direction, max_frame)
        self._noise = NoiseLane(self._table)
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
    def counters(self) -> Counters:
        """What has been seen so far."""
        emitted = self._noise.emitted
        noise, unknown_frames = emitted - self._message_bytes, self._noise.unknown_frames
        return Counters(emitted + len(self._held), self._messages, noise, unknown_frames)

    def __copy__(self) -> StreamDecoder:
        other = _new(type(self))
        for name in self.__slots__:
            setattr(other, name, getattr(self, name))
        other._noise = self._noise.copy()
        return other

    def feed(self, data: bytes | bytearray | memoryview) -> list[Event]:
        """Take in bytes, and return the events that are certain now. b"" is no sign of silence."""
        held = self._held + (data if type(data) is bytes else as_bytes(data))
        if len(held) < self._wake:
            self._held = held
            return []
        if len(held) <= _REMEMBERED:
            wake = self._table.waits.get(held)
            if wake is not None:
                self._held, self._wake = held, wake
                return []
        return self._read(held, quiet=False)

    def flush(self) -> list[Event]:
        """Decode the bytes held back, as the line is quiet: they are no frame, but may hide one."""
        events = self._read(self._held, quiet=True)
        self._noise.begin_anew(self._noise.emitted)
        return events

    def _read(self, data: bytes, *, quiet: bool) -> list[Event]:
        """Return the events that are certain, and keep the rest of the bytes."""
        events: list[typing.Any] = []
        look_up, noise = self._table.get, self._noise
        base, size, at = noise.emitted, len(data), self._scanned
        # Where a search goes on, no frame can begin before it has ended.
        entry = None if at else look_up(data[:BODY_AT])
        while True:
            begun, before = at, len(events)
            while entry is not None:
                length, count_at, count_end, count, kind, other = entry
                if data[at + count_at : at + count_end] != count:
                    entry = other
                    continue
                end = at + length
                if end > size:
                    break
                message = _new(kind)
                message._frame = data[at:end]
                events.append(message)
                at = end
                entry = look_up(data[at : at + BODY_AT])
            if at > begun:
                self._messages += len(events) - before
                self._message_bytes += at - begun
                noise.begin_anew(base + at)
                if at == size:
                    self._hold(data, at, at, at)
                    return events
            if entry is not None and not quiet:
                self._hold(data, at, at, at + entry[0])
                return events
            entry = noise.search(events, data, base, at, quiet=quiet)
            at = noise.at - base
            if entry is None:
                self._hold(data, noise.emitted - base, at, noise.wake - base)
                return events

    def _hold(self, data: bytes, start: int, scanned: int, wake: int) -> None:
        """Keep the bytes from `start` on, which allow no event before `wake` bytes are here."""
        self._held = held = data[start:]
        self._scanned, self._wake = scanned - start, wake - start
        if 0 < len(held) <= _REMEMBERED and scanned == start:
            self._table.wait(held, self._wake)
