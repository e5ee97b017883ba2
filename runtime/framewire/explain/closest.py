"""Which frame comes closest to bytes that are none: its envelope and, if it is known, its message.

Whoever refuses bytes says why and where. What they were taken for follows from that.
"""

from __future__ import annotations

from dataclasses import dataclass

from .refusals import (
    BAD_CHECKSUM,
    BAD_HEADER,
    BAD_TRAILER,
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    OUT_OF_RANGE,
    TOO_SHORT,
    TRAILING_BYTES,
    UNKNOWN_COMMAND,
)
from .slot_bytes import holds, is_in, legal_length, piece, read_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ..protocol.envelope import Envelope
    from ..protocol.message import Message
    from ..protocol.places import Placed
    from ..protocol.protocol import Protocol

# Which slots bytes are refused by, as far as the reason tells.
_ROLES = {
    BAD_HEADER: ("constant",),
    BAD_TRAILER: ("constant",),
    LENGTH_MISMATCH: ("length",),
    COUNT_MISMATCH: ("count", "size"),
    UNKNOWN_COMMAND: ("id",),
    BAD_CHECKSUM: ("checksum",),
}


def closest(
    protocol: Protocol, direction: str, data: bytes, reason: str, offset: int
) -> list[Attempt]:
    """Return what `data` was refused as: several, where nothing tells them apart."""
    found = list(_attempts(protocol, direction, data, reason, offset))
    best = max(attempt.nearness for attempt in found)
    return [attempt for attempt in found if attempt.nearness == best]


def _attempts(
    protocol: Protocol, direction: str, data: bytes, reason: str, offset: int
) -> Iterator[Attempt]:
    frames = [*protocol.envelopes.values()]
    for frame in [each for each in frames if protocol.sent(direction, each)] or frames:
        messages = _begun(protocol.sent(direction, frame), frame, data[:offset]) or (None,)
        for message in messages:
            yield Attempt(frame, message, data, reason, offset)


def _begun(messages: Sequence[Message], frame: Envelope, data: bytes) -> Sequence[Message]:
    """Return those messages in an envelope that `data` begins: none until its ids tell."""
    ids = tuple(read_in(part, data) for part in frame.ids if is_in(part, data))
    found = [each for each in messages if each.seen_ids[: len(ids)] == ids]
    if len(found) == 1:
        return found
    if len(ids) < len(frame.ids):
        return ()
    if frame.length is not None and is_in(frame.length, data):
        return [each for each in found if legal_length(each, data) is not None] or found
    return found


@dataclass(frozen=True)
class Attempt:
    """Bytes taken for a frame of an envelope, of a message if their ids are known."""

    frame: Envelope
    message: Message | None
    data: bytes
    reason: str
    offset: int

    @property
    def name(self) -> str:
        """What they were taken for."""
        return self.frame.name if self.message is None else self.message.name

    @property
    def nearness(self) -> tuple[bool, bool]:
        """Whether all is right in front of the offset, and wrong there as the reason says."""
        before = all(
            holds(placed.slot, piece(placed, self.data))
            for placed in self.slots
            if self._precedes(placed)
        )
        return before, self._is_refused

    @property
    def slots(self) -> tuple[Placed, ...]:
        """The slots of the frame; without a message, those in front of its fields."""
        if self.message is None:
            return self.frame.head
        length = legal_length(self.message, self.data)
        return tuple(self.message.lay_out(self.message.lengths[0] if length is None else length))

    def _precedes(self, placed: Placed) -> bool:
        return placed.end <= self.offset

    @property
    def _is_refused(self) -> bool:
        if self.message is None and all(
            is_in(part, self.data[: self.offset]) for part in self.frame.ids
        ):
            # There is no message of these ids, and that would have been the reason.
            return False
        end = self.slots[-1].end if self.slots else 0
        if self.reason == TRAILING_BYTES:
            return end == self.offset
        if self.reason == TOO_SHORT:
            return end > len(self.data)
        there = (placed for placed in self.slots if placed.at <= self.offset < placed.end)
        placed = next(there, None)
        if placed is None:
            return False
        if self.reason == OUT_OF_RANGE:
            return not holds(placed.slot, piece(placed, self.data))
        return placed.slot.role in _ROLES[self.reason]
