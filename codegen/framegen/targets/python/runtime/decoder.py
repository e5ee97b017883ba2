"""Decodes a stream of bytes, of which any part may be noise, into messages and noise.

There is no checksum, so a header is believed only while everything after it agrees: a length that
the command can have, a count that follows from the length. A header that is refused costs one byte,
never the length that it claimed, so that noise cannot swallow the frame behind it.
"""

from __future__ import annotations

from .codec import table_for
from .errors import Reason
from .noise import Noise, UnknownFrame
from .octets import octets
from .protocol import BODY_AT, HEADER, LENGTH_END, UNCOUNTED, read_command, read_length

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .direction import Direction
    from .message import Message

_new = object.__new__

# The beginnings of frames that are remembered, with what they wait for, are of this size at most.
_REMEMBERED = BODY_AT + 1

# What a header that has not come whole may look like, the longest first.
_BEGUN_HEADERS = [HEADER[:size] for size in range(len(HEADER) - 1, 0, -1)]


class Counters:
    """What a decoder has seen: bytes fed, messages, bytes of noise, unknown frames in it."""

    __slots__ = ("fed", "messages", "noise", "unknown_frames")

    def __init__(self, fed: int, messages: int, noise: int, unknown_frames: int) -> None:
        self.fed = fed
        self.messages = messages
        self.noise = noise
        self.unknown_frames = unknown_frames

    def __repr__(self) -> str:
        counts = ", ".join(f"{name}={getattr(self, name)}" for name in self.__slots__)
        return f"Counters({counts})"


class StreamDecoder:
    """Turns bytes, fed in pieces of any size, into messages and noise.

    Nothing is lost: the bytes of all messages and all noise, in order, are the bytes that were fed.
    How they were cut makes no difference, save that one piece of noise may come as several. It
    never raises on input, and never holds more than the largest legal frame.

    `direction` says who sends: on a client's end that of what the device sends, and None for a line
    on which both are heard. Where a frame is legal in both, it is the first's.
    """

    __slots__ = (
        "_candidate",
        "_held",
        "_messages",
        "_noise",
        "_reason",
        "_scanned",
        "_table",
        "_told",
        "_unknown",
        "_wake",
    )

    def __init__(self, direction: Direction | None) -> None:
        self._table = table_for(direction)
        self._held = b""
        # Where in what is held the search goes on, and the size below which it need not.
        self._scanned = 0
        self._wake = 0
        # Where the frame of unknown command at the start of what is held would end; 0 for none.
        self._candidate = 0
        # Why the noise that is being read is noise.
        self._reason = Reason.BAD_HEADER
        # Bytes told, messages, bytes of noise, and frames of unknown command.
        self._told = self._messages = self._noise = self._unknown = 0

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
        """How many bytes must come at the least before anything is told."""
        return max(1, self._wake - len(self._held))

    @property
    def counters(self) -> Counters:
        """What has been seen so far."""
        fed = self._told + len(self._held)
        return Counters(fed, self._messages, self._noise, self._unknown)

    def feed(self, data: bytes | bytearray | memoryview) -> list[Message | Noise]:
        """Takes in bytes, and returns what can be told now. Empty bytes are no sign of silence."""
        held = self._held + (data if type(data) is bytes else octets(data))
        if len(held) < self._wake:
            self._held = held
            return []
        if len(held) <= _REMEMBERED and not self._candidate:
            wake = self._table.waits.get(held)
            if wake is not None:
                self._held, self._wake = held, wake
                return []
        return self._search(held, quiet=False)

    def flush(self) -> list[Message | Noise]:
        """Says that the line has gone quiet: what is held is no frame, but may hide one."""
        events = self._search(self._held, quiet=True)
        self._reason = Reason.BAD_HEADER
        return events

    def _search(self, data: bytes, *, quiet: bool) -> list[Message | Noise]:
        """Tells what can be told, and keeps the rest. `at` never goes back: time is linear."""
        events: list[Message | Noise] = []
        look_up = self._table.get
        size = len(data)
        # From `start` to `at` is noise that has not been told yet, all of it for one reason, unless
        # it may be a frame of unknown command, which ends at `candidate`.
        start, at, candidate = 0, self._scanned, self._candidate
        refused, reason = -2, self._reason  # where the last refused header stands, and why
        messages = wake = 0
        while True:
            # Whether a frame of unknown command is shown as one is decided by its own bytes alone,
            # or else the answer would depend on how the stream was cut.
            whole = 0 < candidate <= size
            limit = candidate if whole else size
            if at == limit:
                if whole:
                    self._tell_unknown(events, data, start, candidate)
                    start, candidate = candidate, 0
                    continue
                if quiet or not candidate:
                    self._tell_noise(events, data, start, at, candidate)
                    start, candidate = at, 0
                break
            kind: type[Message] | None = None
            entry = look_up(data[at : at + BODY_AT])
            if entry is not None:
                length, count_at, count_end, count, likely = entry
                end = at + length
                if end <= limit and data[at + count_at : at + count_end] == count:
                    kind = likely
                else:
                    # What is here of the count may refuse the header before all of it is here.
                    reason = Reason.TOO_SHORT
                    begun = data[at + count_at : min(at + count_end, limit)]
                    if not count.startswith(begun):
                        end, reason = 0, Reason.COUNT_MISMATCH
                    elif begun != count:
                        end = at + count_end
            elif (found := _next_header(data, at, limit)) > at:
                at = found
                continue
            else:
                kind, end, reason = self._weigh(data, at, limit)
            if kind is not None:
                if start < at:
                    self._tell_noise(events, data, start, at, candidate)
                message = _new(kind)
                message._frame = data[at:end]
                events.append(message)
                messages += 1
                self._reason = Reason.BAD_HEADER
                start = at = end
                candidate = 0
            elif end and whole:
                # What may begin here goes on behind the unknown frame, and is worth more than it.
                self._tell_noise(events, data, start, at, candidate)
                start, candidate = at, 0
            elif end and not quiet:
                if not candidate:
                    self._tell_noise(events, data, start, at)
                    start = at
                wake = min(end, candidate) if candidate else end
                break
            else:
                if not candidate and data.startswith(HEADER, at):
                    candidate = self._claimed(data, at)
                    # A run of headers, each a byte after the other, is one piece.
                    if candidate or reason is not self._reason or at != refused + 1:
                        self._tell_noise(events, data, start, at)
                        start, self._reason = at, reason
                    refused = at
                at = _next_header(data, at + 1, min(size, candidate) if candidate else size)
        self._held = held = data[start:]
        self._scanned = at - start
        self._candidate = candidate - start if candidate else 0
        self._wake = wake - start
        if held and not candidate and len(held) <= _REMEMBERED:
            self._table.waits[held] = self._wake
        self._told += start
        self._messages += messages
        return events

    def _weigh(self, data: bytes, at: int, limit: int) -> tuple[type[Message] | None, int, Reason]:
        """What the header at `at` begins, by the bytes in front of `limit`.

        A message and where it ends; or no message, and the size at which more can be told; or no
        message, 0 and the reason.
        """
        head = data[at : min(at + BODY_AT, limit)]
        if len(head) >= LENGTH_END and not self._table.may_have(read_length(head)):
            return None, 0, Reason.LENGTH_MISMATCH
        if len(head) < BODY_AT:
            return None, limit + 1, Reason.TOO_SHORT
        known = read_command(head) in self._table.kinds
        reason = Reason.LENGTH_MISMATCH if known else Reason.UNKNOWN_COMMAND
        for length, count_at, count_end, count, kind in self._table.entries(head):
            if not count.startswith(data[at + count_at : min(at + count_end, limit)]):
                reason = Reason.COUNT_MISMATCH
            elif at + count_end > limit:
                return None, at + count_end, Reason.TOO_SHORT
            elif at + length > limit:
                return None, at + length, Reason.TOO_SHORT
            elif kind.SHAPE.out_of_range(data[at : at + length]) is None:
                self._table[head]  # learns it for the next time
                return kind, at + length, reason
            else:
                reason = Reason.OUT_OF_RANGE
        return None, 0, reason

    def _claimed(self, data: bytes, at: int) -> int:
        """Where a frame of unknown command at `at` would end; 0 where none begins."""
        head = data[at : at + BODY_AT]
        if len(head) < BODY_AT or not head.startswith(HEADER):
            return 0
        length = read_length(head)
        unknown = read_command(head) not in self._table.kinds
        return at + length + UNCOUNTED if unknown and self._table.may_have(length) else 0

    def _tell_unknown(
        self, events: list[Message | Noise], data: bytes, start: int, end: int
    ) -> None:
        self._noise += end - start
        self._unknown += 1
        self._reason = Reason.BAD_HEADER
        events.append(UnknownFrame(data[start:end], Reason.UNKNOWN_COMMAND))

    def _tell_noise(
        self, events: list[Message | Noise], data: bytes, start: int, end: int, wreck: int = 0
    ) -> None:
        """Tells the bytes from `start` to `end`, which may be the wreck of an unknown frame."""
        if wreck:
            start = self._tell_wreck(events, data, start, end)
        if start < end:
            self._noise += end - start
            events.append(Noise(data[start:end], self._reason))

    def _tell_wreck(self, events: list[Message | Noise], data: bytes, start: int, end: int) -> int:
        """Tells what a frame of unknown command leaves that was none, up to its last piece.

        There is a piece for each refused header in it, save that a run of headers, each a byte
        after the other, is one. No message is in there, but other frames of unknown command may be.
        Returns where the last piece begins.
        """
        at, refused = start, -2
        while at < end:
            if data.startswith(HEADER, at):
                claimed = self._claimed(data, at)
                reason = self._weigh(data, at, len(data))[-1]
                if 0 < claimed <= end:
                    self._tell_noise(events, data, start, at)
                    self._tell_unknown(events, data, at, claimed)
                    start = at = claimed
                    at = _next_header(data, at, end)
                    continue
                if reason is not self._reason or at != refused + 1:
                    self._tell_noise(events, data, start, at)
                    start, self._reason = at, reason
                refused = at
            at = _next_header(data, at + 1, end)
        return start


def _next_header(data: bytes, at: int, limit: int) -> int:
    """The first place from `at` on where a header stands, or may begin at the very end."""
    found = data.find(HEADER, at, limit)
    if found >= 0:
        return found
    for begun in _BEGUN_HEADERS:
        if data.endswith(begun, at, limit):
            return limit - len(begun)
    return limit
