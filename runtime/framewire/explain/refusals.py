"""Words for what a frame should have had where bytes stop being one."""

from __future__ import annotations

from dataclasses import dataclass

from ..frame.pluralize import describe_range, pluralize
from ..protocol.places import lay_out
from ..protocol.slots import Constant, Number, Packed
from .checksum import right
from .slot_bytes import frame_length, is_in, legal_length, piece, read, read_in, value_of
from .words import listed, opening

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import TypeVar

    from ..protocol.envelope import Envelope
    from ..protocol.message import Message
    from ..protocol.places import Placed
    from ..protocol.protocol import Protocol

    _Kind = TypeVar("_Kind", Constant, Number)

# The reasons for which bytes are no frame. Every target and the test vectors use these words.
TOO_SHORT = "too short"
TRAILING_BYTES = "trailing bytes"
BAD_HEADER = "bad header"
LENGTH_MISMATCH = "length mismatch"
COUNT_MISMATCH = "count mismatch"
UNKNOWN_COMMAND = "unknown command"
OUT_OF_RANGE = "out of range"
BAD_CHECKSUM = "bad checksum"
BAD_TRAILER = "bad trailer"


@dataclass(frozen=True)
class Refused:
    """Bytes that are no frame of an envelope, sent in any of some directions.

    `likely` is the message that they began, if it is known. No frame has more than `largest` bytes.
    """

    protocol: Protocol
    frame: Envelope
    directions: Sequence[object]
    data: bytes
    reason: str
    offset: int
    likely: Message | None
    largest: int

    def expected(self) -> str:
        """Say what was due."""
        return {
            TOO_SHORT: self._more,
            TRAILING_BYTES: self._size,
            BAD_HEADER: self._opening,
            LENGTH_MISMATCH: self._legal_lengths,
            COUNT_MISMATCH: self._count,
            UNKNOWN_COMMAND: self._command,
            OUT_OF_RANGE: self._range,
            BAD_CHECKSUM: self._checksum,
            BAD_TRAILER: self._trailer,
        }[self.reason]()

    def _more(self) -> str:
        """Say how much more there should be."""
        placed = self._placed()
        slot = placed.slot
        is_part = isinstance(slot, Constant) and slot.role == "constant" and not slot.is_field
        if is_part and slot.at >= 0:
            return self._opening()
        if placed.at < self.frame.body_at or self._length() is None:
            return f"the shortest frame has {pluralize(self._least(), 'byte')}"
        return self._size()

    def _least(self) -> int:
        """Return the size of the smallest frame that there may be."""
        if self.likely is None or self.frame.length is not None:
            return self.frame.least
        return self.likely.lengths[0]

    def _size(self) -> str:
        """Say how long a frame of the length is that these bytes have."""
        length = self._length() or 0
        size = length + self.frame.uncounted
        if self.frame.length is None:
            return f"this frame of {self._likely_name} has {pluralize(size, 'byte')}"
        return f"a {self.frame.length.name} of {length} makes {pluralize(size, 'byte')}"

    @property
    def _likely_name(self) -> str:
        return "a message" if self.likely is None else self.likely.name

    def _opening(self) -> str:
        return opening(self.protocol, map(str, self.directions))

    def _count(self) -> str:
        placed, length = self._placed(), self._length()
        slot, found = self._at_offset(Number), piece(placed, self.data)
        if length is None or self.frame.length is None:
            lists = None if self.likely is None else self.likely.items
            bounds = "" if lists is None else f", of {lists.low}..{lists.high} elements"
            return f"no {self._likely_name} has a {placed.path} of {read(slot, found)}{bounds}"
        count = 0 if self.likely is None else self.likely.counted_at(slot, length)
        has = f"a {self.frame.length.name} of {length} makes {placed.path} {count}"
        return has if len(found) < placed.size else f"{has}, not {read(slot, found)}"

    def _command(self) -> str:
        ways = " or ".join(map(str, self.directions))
        there = (part for part in self.frame.ids if part.at <= self.offset)
        ids = " and ".join(f"{part.name} {read_in(part, self.data)}" for part in there)
        return f"no message {ways} has the {ids}"

    def _range(self) -> str:
        placed = self._placed()
        slot, path = placed.slot, placed.path
        if isinstance(slot, Constant):
            return f"{path} is always {slot.data.hex(' ').upper()}"
        if not isinstance(slot, (Number, Packed)):
            return f"{path} has the byte {self.data[self.offset]:02X}, which is not ASCII"
        value = value_of(slot, piece(placed, self.data))
        if isinstance(value, list):
            outside = [each for each in enumerate(value) if not slot.low <= each[1] <= slot.high]
            (index, value), *_ = outside
            path = f"{path}[{index}]"
        return f"{path} is {value}, outside {slot.low}..{slot.high}"

    def _checksum(self) -> str:
        slot = self._at_offset(Number)
        unsent = () if self.likely is None else self.likely.unsent_ids
        whole = self.data[: (self._length() or 0) + self.frame.uncounted]
        due = right(self.frame, slot, whole, unsent).hex(" ").upper()
        found = piece(self._placed(), self.data).hex(" ").upper()
        return f"{slot.name} is {found}; the {slot.method} of {listed(slot.of)} is {due}"

    def _trailer(self) -> str:
        slot = self._at_offset(Constant)
        return f"{slot.name} is always {slot.data.hex(' ').upper()}"

    def _length(self) -> int | None:
        """Return the length that the bytes claim, or that a message has with them."""
        if self.frame.length is not None:
            return frame_length(self.frame, self.data)
        return None if self.likely is None else legal_length(self.likely, self.data)

    def _at_offset(self, kind: type[_Kind]) -> _Kind:
        """Return the slot at the offset, of the kind that is refused for the reason."""
        slot = self._placed().slot
        if not isinstance(slot, kind):
            raise TypeError(f"{self.reason} at {slot.name}, which is no {kind.__name__}")
        return slot

    def _placed(self) -> Placed:
        """Return the slot at the offset."""
        slots = [*self.frame.head]
        likely = self.likely
        if likely is not None and (not slots or self.offset >= slots[-1].end):
            length = likely.lengths[0] if self._length() is None else self._length()
            slots += likely.lay_out(length or 0)
        slots += lay_out(self.frame.slots, max(len(self.data), self.frame.least))
        # At the end of them all, what is missing is more than any frame has.
        return next((placed for placed in slots if self.offset < placed.end), slots[-1])

    def _legal_lengths(self) -> str:
        frame, found = self.frame, self._named()
        name = frame.length_name
        if found:
            has = " or ".join(
                f"{message.name} has a {name} of {describe_range(message.lengths)}"
                for message in found
            )
        else:
            least, most = (each - frame.uncounted for each in (frame.least, self.largest))
            has = f"the {name} of a frame is {least}..{most}"
        return f"{has}, not {self._length()}"

    def _named(self) -> list[Message]:
        """Return the messages that have the ids of these bytes, whatever precedes them."""
        if not all(is_in(part, self.data) for part in self.frame.ids):
            return []
        ids = tuple(read_in(part, self.data) for part in self.frame.ids)
        return [
            message
            for way in self.directions
            for message in self.protocol.sent(str(way), self.frame)
            if message.seen_ids == ids
        ]
