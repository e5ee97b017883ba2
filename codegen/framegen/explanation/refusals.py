"""Words for what a frame should have had where bytes stop being one."""

from __future__ import annotations

from dataclasses import dataclass

from ..pluralize import describe_range

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from .protocol import Message, Placed, Protocol

# The reasons for which bytes are no frame. Every target and the test vectors use these words.
TOO_SHORT = "too short"
TRAILING_BYTES = "trailing bytes"
BAD_HEADER = "bad header"
LENGTH_MISMATCH = "length mismatch"
COUNT_MISMATCH = "count mismatch"
UNKNOWN_COMMAND = "unknown command"
OUT_OF_RANGE = "out of range"


@dataclass(frozen=True)
class Refused:
    """Bytes that are no frame, sent in any of some directions: the reason, and where it shows.

    `likely` is the message that they began, if it is known. No frame has more than `largest` bytes.
    """

    protocol: Protocol
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
        }[self.reason]()

    def _more(self) -> str:
        """Say how much more there should be."""
        frame, placed = self.protocol.frame, self._placed()
        if placed.slot.role == "constant":
            return self._opening()
        if placed.at < frame.body_at:
            return f"the shortest frame has {frame.least} bytes"
        return self._size()

    def _size(self) -> str:
        """Say how long a frame of the length is that these bytes have."""
        frame, length = self.protocol.frame, self._length()
        return f"a {frame.length.name} of {length} makes {length + frame.uncounted} bytes"

    def _opening(self) -> str:
        return self.protocol.frame.opening

    def _count(self) -> str:
        placed, name, length = self._placed(), self.protocol.frame.length.name, self._length()
        count = 0 if self.likely is None else self.likely.count_at(length)
        has = f"a {name} of {length} makes {placed.path} {count}"
        found = placed.of(self.data)
        return has if len(found) < placed.size else f"{has}, not {placed.slot.read(found)}"

    def _command(self) -> str:
        ways, number = " or ".join(map(str, self.directions)), self.protocol.frame.id
        return f"no message {ways} has the {number.name} {number.read_in(self.data)}"

    def _range(self) -> str:
        placed = self._placed()
        slot, value = placed.slot, placed.slot.read(placed.of(self.data))
        return f"{placed.path} is {value}, outside {slot.low}..{slot.high}"

    def _length(self) -> int:
        return self.protocol.frame.length.read_in(self.data)

    def _placed(self) -> Placed:
        """Return the slot at the offset."""
        slots = [*self.protocol.frame.head]
        if self.likely is not None and self.offset >= slots[-1].end:
            slots += self.likely.lay_out(self._length())
        return next(placed for placed in slots if self.offset < placed.end)

    def _legal_lengths(self) -> str:
        frame, found = self.protocol.frame, self._named()
        name = frame.length.name
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
        """Return the messages that have the id of these bytes, whatever precedes it."""
        place = self.protocol.frame.id
        if not place.is_in(self.data):
            return []
        number = place.read_in(self.data)
        found = (self.protocol.message(str(way), number) for way in self.directions)
        return [message for message in found if message is not None]
