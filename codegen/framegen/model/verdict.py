"""The verdict on bytes as the beginning of a frame, with the one reason why they are none.

The bytes are examined in the order in which they arrive; the first that no legal frame can have
gives the reason and the offset. Single frames and streams are judged by this alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache, partial
from itertools import islice
from typing import TYPE_CHECKING

from framewire.explain.refusals import (
    BAD_CHECKSUM,
    BAD_HEADER,
    BAD_TRAILER,
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    OUT_OF_RANGE,
    TOO_SHORT,
    TRAILING_BYTES,
    UNKNOWN_COMMAND,
    Refused,
)

from framegen.model.slots import Constant, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Candidates, Model
    from framegen.model.slots import Placed


@dataclass(frozen=True, slots=True)
class Verdict:
    """The verdict on some bytes: a message, no frame, or not yet decided.

    Of a message, `offset` is where its frame ends. Else `message` is None, and `reason` and
    `offset` say where it shows that this is no frame: `too short` may still become one.
    `due` says what was expected. `seen` are the slots that agreed up to there, and `likely` is the
    message that they began, if it is known.

    Of a frame of unknown id, `claim` is the size that it claims; the size of the smallest frame, as
    long as its head is cut short; 0 for a size that no frame has. `provable` tells whether a
    checksum decides about it, and `proven` whether it has decided for it.

    `frame` is the name of the envelope, empty where none begins.
    """

    message: MessageLayout | None
    reason: str
    offset: int
    due: Callable[[], str]
    seen: tuple[Placed, ...]
    likely: MessageLayout | None
    claim: int = 0
    provable: bool = False
    proven: bool = False
    frame: str = ""

    @property
    def undecided(self) -> bool:
        """Whether more bytes could still make a frame of it."""
        return self.reason == TOO_SHORT

    @property
    def frame_size(self) -> int:
        """The size of the frame that is there: of a message, or of a proven frame of unknown id."""
        return self.claim if self.message is None else self.offset

    def waits(self, size: int) -> bool:
        """Whether more than these `size` bytes could still make a certain frame of it."""
        return self.undecided or (self.provable and self.claim > size)

    @property
    def expected(self) -> str:
        """What was due."""
        return self.due()

    @property
    def refusal(self) -> str:
        """Why this is no frame, in a line: `too short at byte 4: a length of 8 makes 10 bytes`."""
        return f"{self.reason} at byte {self.offset}: {self.expected}"


class _Refused(Exception):  # noqa: N818 - says what became of the bytes
    def __init__(self, reason: str, offset: int) -> None:
        super().__init__(reason, offset)
        self.verdict = reason, offset


def weigh(
    model: Model,
    directions: Sequence[Direction],
    data: bytes,
    max_frame: int | None = None,
    *,
    quiet: bool = True,
) -> Verdict:
    """Judge what `data` begins, sent in any of `directions`; it may go on behind the frame.

    Frames larger than `max_frame` bytes are refused by their length. Of several that it may be, it
    is the longest, since a frame may begin as a shorter one by chance; a frame that is legal in
    several directions belongs to the first. Where it is legal in none, the refusal with the largest
    offset is given, that of what may still become one before all others; so it is unless the line
    is `quiet`, as long as a longer frame may come.
    """
    if data and data[0] not in model.first_bytes:
        return _begins_otherwise(model, tuple(directions))
    verdicts = [
        verdict
        for candidates in model.candidates(directions)
        for verdict in _Look(model, candidates, directions, data, max_frame).verdicts()
    ]
    certain = [verdict for verdict in verdicts if verdict.message is not None or verdict.proven]
    waiting = [verdict for verdict in verdicts if verdict.waits(len(data))]
    # Of equals, `max` gives the first.
    if certain and (quiet or not waiting):
        return max(certain, key=lambda each: (each.frame_size, each.message is not None))
    return max(waiting or verdicts, key=lambda verdict: verdict.offset, default=_NOTHING)


def weigh_whole(model: Model, directions: Sequence[Direction], data: bytes) -> Verdict:
    """Judge `data` as exactly one frame: bytes behind the frame are refused, too."""
    verdict = weigh(model, directions, data)
    if verdict.message is None or verdict.offset == len(data):
        return verdict
    return replace(verdict, message=None, reason=TRAILING_BYTES)


# No message goes that way.
_NOTHING = Verdict(None, BAD_HEADER, 0, partial(str, "no message goes this way"), (), None)


@lru_cache
def _begins_otherwise(model: Model, directions: tuple[Direction, ...]) -> Verdict:
    """Return the verdict on most offsets of a line, made once."""
    return Verdict(None, BAD_HEADER, 0, partial(model.opening, directions), (), None)


class _Look:
    """One offset where a frame of an envelope may begin, examined slot by slot."""

    def __init__(
        self,
        model: Model,
        candidates: Candidates,
        directions: Sequence[Direction],
        data: bytes,
        max_frame: int | None,
    ) -> None:
        self.model = model
        self.candidates = candidates
        self.frame = candidates.frame
        self.directions = directions
        self.data = data
        self.max_frame = max_frame
        # The size of the largest frame that there may be.
        largest = candidates.largest
        self.largest = largest if max_frame is None else min(largest, max_frame)
        self.seen: list[Placed] = []
        self.likely: MessageLayout | None = None

    def verdicts(self) -> list[Verdict]:
        """Judge the bytes as each message that its head allows, or as none."""
        if self.candidates.messages and self.frame.least > self.largest:
            return []
        try:
            length, candidates = self.head()
        except _Refused as refused:
            if refused.verdict[0] == UNKNOWN_COMMAND:
                return [self._unknown(refused.verdict[1])]
            return [self.refused(*refused.verdict, self.seen, self.likely)]
        return [self.fields(message, length) for message in candidates]

    def head(self) -> tuple[int | None, Sequence[MessageLayout]]:
        """Read the slots in front of the fields: the length, and the messages that can have it."""
        length: int | None = None
        ids: tuple[int, ...] = ()
        ids_left = len(self.frame.sent_ids)
        candidates = self._with_ids(ids)
        for placed in self.frame.placed_head:
            slot = placed.slot
            if isinstance(slot, Constant):
                self._constant(placed, slot)
            elif isinstance(slot, Number):
                found = self._whole(placed)
                number = slot.read(found)
                match slot.role:
                    case "length":
                        length = self._length(number)
                    case "id":
                        ids = (*ids, number)
                        candidates = self._with_ids(ids, slot)
                        ids_left -= 1
                    case "address":
                        self._address(placed, slot)
            self.seen.append(placed)
            if length is not None and not ids_left:
                candidates = self._fitting(candidates, length)
        return length, candidates

    def fields(self, message: MessageLayout, length: int | None) -> Verdict:
        """Judge what follows the head as the rest of one message."""
        seen = list(self.seen)
        try:
            count = self._count(message) if length is None else message.count_at(length)
            for placed in islice(message.lay_out(count), len(seen), None):
                self._field(message, placed, count)
                seen.append(placed)
            size = message.size_at(count)
            self._proven(message.checksum, self.data[:size])
        except _Refused as refused:
            return self.refused(*refused.verdict, seen, message)
        due = self._due(TRAILING_BYTES, size, message)
        return Verdict(message, "", size, due, tuple(seen), message, frame=self.frame.name)

    def refused(
        self,
        reason: str,
        offset: int,
        seen: Sequence[Placed],
        likely: MessageLayout | None,
    ) -> Verdict:
        """Return the verdict for a refusal."""
        due = self._due(reason, offset, likely)
        return Verdict(None, reason, offset, due, tuple(seen), likely, frame=self.frame.name)

    def _unknown(self, offset: int) -> Verdict:
        """Return the verdict on a frame of unknown id."""
        claim = self._claim()
        refused = self.refused(UNKNOWN_COMMAND, offset, self.seen, self.likely)
        provable = self.frame.proves_unknown and claim > 0
        proven = provable and self.frame.body_at <= claim <= len(self.data)
        if proven:
            try:
                self._around(self.data[:claim])
            except _Refused:
                proven = False
        return replace(refused, claim=claim, provable=provable, proven=proven)

    def _claim(self) -> int:
        """Return the size that a frame of unknown id claims; 0 for a size that no frame has."""
        if len(self.data) < self.frame.body_at:
            return self.frame.least
        if self.frame.length_part is None:
            return 0
        size = self.frame.length.read_in(self.data) + self.frame.uncounted
        return size if self._is_possible(size) else 0

    def _around(self, frame: bytes) -> None:
        """Refuse what is around the fields of a frame of unknown id, unless all of it is right."""
        for placed in self.frame.lay_out(len(frame)):
            slot = placed.slot
            if isinstance(slot, Constant):
                self._constant(placed, slot)
            elif isinstance(slot, Number) and slot.role == "address":
                self._address(placed, slot)
        self._proven(
            lambda checksum, data: self.frame.covered(checksum, {}).checksum(checksum, data), frame
        )

    def _proven(self, expected: Callable[[Number, bytes], bytes], frame: bytes) -> None:
        """Refuse a whole frame that has other checksums than `expected`."""
        for checksum in self.frame.checksums:
            at = checksum.at if checksum.at >= 0 else len(frame) + checksum.at
            if frame[at : at + checksum.size] != expected(checksum, frame):
                raise _Refused(BAD_CHECKSUM, at)

    def _due(self, reason: str, offset: int, likely: MessageLayout | None) -> Callable[[], str]:
        """Return what says what is expected: few verdicts are asked."""
        return partial(self._expected, reason, offset, likely)

    def _expected(self, reason: str, offset: int, likely: MessageLayout | None) -> str:
        plain, ways = self.model.protocol, self.directions
        message = None if likely is None else plain.messages[likely.name]
        frame, largest = plain.envelopes[self.frame.name], self.largest
        refused = Refused(plain, frame, ways, self.data, reason, offset, message, largest)
        return refused.expected()

    def _constant(self, placed: Placed, slot: Constant) -> None:
        found = placed.of(self.data)
        if slot.role == "constant":
            for at, (byte, right) in enumerate(zip(found, slot.data, strict=False), placed.at):
                if byte != right:
                    reason = BAD_HEADER if slot.at >= 0 else BAD_TRAILER
                    raise _Refused(reason if slot.field is None else OUT_OF_RANGE, at)
        if len(found) < placed.size:
            raise _Refused(TOO_SHORT, len(self.data))

    def _address(self, placed: Placed, slot: Number) -> None:
        if not slot.holds(slot.read(self._whole(placed))):
            raise _Refused(OUT_OF_RANGE, placed.at)

    def _whole(self, placed: Placed) -> bytes:
        found = placed.of(self.data)
        if len(found) < placed.size:
            raise _Refused(TOO_SHORT, len(self.data))
        return found

    def _length(self, length: int) -> int:
        if not self._is_possible(length + self.frame.uncounted):
            raise _Refused(LENGTH_MISMATCH, self.frame.length.at)
        return length

    def _is_possible(self, size: int) -> bool:
        return self.frame.least <= size <= self.largest

    def _short_enough(self, messages: Sequence[MessageLayout]) -> Sequence[MessageLayout]:
        """Return the messages that fit into `max_frame`, where no length tells of their size."""
        if self.max_frame is None or self.frame.length_part is not None:
            return messages
        return [message for message in messages if message.least <= self.max_frame]

    def _with_ids(
        self, ids: tuple[int, ...], part: Number | None = None
    ) -> Sequence[MessageLayout]:
        """Return the messages whose ids begin with these, the last of them in `part`."""
        found = self._short_enough(self.candidates.with_ids(ids))
        if part is not None and not found:
            self.likely = None
            raise _Refused(UNKNOWN_COMMAND, part.at)
        if ids or len(found) == 1:
            self.likely = found[0]
        return found

    def _fitting(self, candidates: Sequence[MessageLayout], length: int) -> Sequence[MessageLayout]:
        fitting = [message for message in candidates if length in message.lengths]
        if not fitting:
            raise _Refused(LENGTH_MISMATCH, self.frame.length.at)
        return fitting

    def _count(self, message: MessageLayout) -> int:
        """Read the count of a message whose frame says nothing of its length."""
        items, least = message.items, message.counts[0]
        if items is None or items.counter is None:
            return least
        for placed in islice(message.lay_out(least), len(self.seen), None):
            if placed.slot is not items.counter:
                self._field(message, placed, least)
                continue
            count = items.count_at(items.counter.read(self._whole(placed)))
            if count is None or message.size_at(count) > self.largest:
                raise _Refused(COUNT_MISMATCH, placed.at)
            return count
        raise AssertionError("the counter of a list is a field")

    def _field(self, message: MessageLayout, placed: Placed, count: int) -> None:
        slot = placed.slot
        match slot:
            case Constant():
                self._constant(placed, slot)
            case Packed():
                values = slot.values(self._whole(placed))
                if not all(slot.low <= value <= slot.high for value in values):
                    raise _Refused(OUT_OF_RANGE, placed.at)
            case Text():
                self._characters(placed, slot)
            case Number():
                self._number(message, placed, slot, count)

    def _characters(self, placed: Placed, slot: Text) -> None:
        try:
            slot.value(self._whole(placed))
        except UnicodeDecodeError as error:
            raise _Refused(OUT_OF_RANGE, placed.at + error.start) from None

    def _number(self, message: MessageLayout, placed: Placed, slot: Number, count: int) -> None:
        items = message.items
        if slot.counts and items is not None:
            due = slot.write(items.counted(slot, count))
            if not due.startswith(placed.of(self.data)):
                raise _Refused(COUNT_MISMATCH, placed.at)
        found = self._whole(placed)
        if not slot.holds(slot.value(found)):
            raise _Refused(OUT_OF_RANGE, placed.at)
