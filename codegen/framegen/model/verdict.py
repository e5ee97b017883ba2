"""The verdict on bytes as the beginning of a frame, with the one reason why they are none.

The bytes are examined in the order in which they arrive; the first that no legal frame can have
gives the reason and the offset. Single frames and streams are judged by this alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache, partial
from itertools import islice
from typing import TYPE_CHECKING

from framegen.explanation.refusals import (
    BAD_HEADER,
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    OUT_OF_RANGE,
    TOO_SHORT,
    TRAILING_BYTES,
    UNKNOWN_COMMAND,
    Refused,
)
from framegen.model.slots import Constant, Number

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Placed


@dataclass(frozen=True, slots=True)
class Verdict:
    """The verdict on some bytes: a message, no frame, or not yet decided.

    Of a message, `offset` is where its frame ends. Else `message` is None, and `reason` and
    `offset` say where it shows that this is no frame: `too short` may still become one.
    `due` says what was expected. `seen` are the slots that agreed up to there, and `likely` is the
    message that they began, if it is known.

    Of a frame of unknown id, `claim` is the size that it claims, which nothing proves; the size of
    the smallest frame, as long as its head is cut short; 0 for a size that no frame has.
    """

    message: MessageLayout | None
    reason: str
    offset: int
    due: Callable[[], str]
    seen: tuple[Placed, ...]
    likely: MessageLayout | None
    claim: int = 0

    @property
    def undecided(self) -> bool:
        """Whether more bytes could still make a frame of it."""
        return self.reason == TOO_SHORT

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
    model: Model, directions: Sequence[Direction], data: bytes, max_frame: int | None = None
) -> Verdict:
    """Judge what `data` begins, sent in any of `directions`; it may go on behind the frame.

    Frames larger than `max_frame` bytes are refused by their length. A frame that is legal in
    several directions belongs to the first; where it is legal in none, the refusal with the
    largest offset is given.
    """
    if data and data[0] != model.frame.header[0]:
        return _begins_otherwise(model.frame.opening)
    look = _Look(model, directions, data, max_frame)
    try:
        length, candidates = look.head()
    except _Refused as refused:
        claim = look.claim() if refused.verdict[0] == UNKNOWN_COMMAND else 0
        return look.refused(*refused.verdict, look.seen, look.likely, claim)
    verdicts = [look.fields(message, length) for message in candidates]
    legal = (verdict for verdict in verdicts if verdict.message is not None)
    # Of equals, `max` gives the first.
    return next(legal, None) or max(verdicts, key=lambda verdict: verdict.offset)


def weigh_whole(model: Model, directions: Sequence[Direction], data: bytes) -> Verdict:
    """Judge `data` as exactly one frame: bytes behind the frame are refused, too."""
    verdict = weigh(model, directions, data)
    if verdict.message is None or verdict.offset == len(data):
        return verdict
    return replace(verdict, message=None, reason=TRAILING_BYTES)


@lru_cache
def _begins_otherwise(opening: str) -> Verdict:
    """Return the verdict on most offsets of a line, made once."""
    return Verdict(None, BAD_HEADER, 0, partial(str, opening), (), None)


class _Look:
    """One offset where a frame may begin, examined slot by slot."""

    def __init__(
        self, model: Model, directions: Sequence[Direction], data: bytes, max_frame: int | None
    ) -> None:
        self.model = model
        self.frame = model.frame
        self.directions = directions
        self.data = data
        self.max_frame = max_frame
        self.seen: list[Placed] = []
        self.likely: MessageLayout | None = None

    @property
    def largest(self) -> int:
        """The size of the largest frame that there may be."""
        largest = self.model.largest(self.directions)
        return largest if self.max_frame is None else min(largest, self.max_frame)

    def head(self) -> tuple[int, list[MessageLayout]]:
        """Read the slots in front of the fields: the length, and the messages that can have it."""
        length: int | None = None
        candidates: list[MessageLayout] | None = None
        for placed in self.frame.placed_head:
            slot = placed.slot
            if isinstance(slot, Constant):
                self._constant(placed, slot)
            elif isinstance(slot, Number):
                number = slot.read(self._whole(placed))
                if slot.role == "length":
                    length = self._length(number)
                elif slot.role == "id":
                    candidates = self._candidates(number)
            self.seen.append(placed)
            if length is not None and candidates is not None:
                candidates = self._fitting(candidates, length)
        if length is None or candidates is None:
            raise AssertionError("the rule frame-parts sees to both")
        return length, candidates

    def claim(self) -> int:
        """Return the size that a frame of unknown id claims; 0 for a size that no frame has."""
        if len(self.data) < self.frame.body_at:
            return self.frame.least
        size = self.frame.length.read_in(self.data) + self.frame.uncounted
        return size if self._is_possible(size) else 0

    def fields(self, message: MessageLayout, length: int) -> Verdict:
        """Judge what follows the head as the fields of one message."""
        count = message.count_at(length)
        size = message.size_at(count)
        seen = list(self.seen)
        try:
            for placed in islice(message.lay_out(count), len(seen), None):
                self._field(placed, count)
                seen.append(placed)
        except _Refused as refused:
            return self.refused(*refused.verdict, seen, message)
        due = self._due(TRAILING_BYTES, size, message)
        return Verdict(message, "", size, due, tuple(seen), message)

    def refused(
        self,
        reason: str,
        offset: int,
        seen: Sequence[Placed],
        likely: MessageLayout | None,
        claim: int = 0,
    ) -> Verdict:
        """Return the verdict for a refusal."""
        due = self._due(reason, offset, likely)
        return Verdict(None, reason, offset, due, tuple(seen), likely, claim)

    def _due(self, reason: str, offset: int, likely: MessageLayout | None) -> Callable[[], str]:
        """Return what says what is expected: few verdicts are asked."""
        return partial(self._expected, reason, offset, likely)

    def _expected(self, reason: str, offset: int, likely: MessageLayout | None) -> str:
        plain, ways = self.model.plain, self.directions
        message = None if likely is None else plain.messages[likely.name]
        return Refused(plain, ways, self.data, reason, offset, message, self.largest).expected()

    def _constant(self, placed: Placed, slot: Constant) -> None:
        found = placed.of(self.data)
        if found == slot.data:
            return
        for at, (byte, right) in enumerate(zip(found, slot.data, strict=False), placed.at):
            if byte != right:
                raise _Refused(BAD_HEADER, at)
        raise _Refused(TOO_SHORT, len(self.data))

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

    def _messages(self, code: int) -> list[MessageLayout]:
        sent = (self.model.sent(direction).get(code) for direction in self.directions)
        return [message for message in sent if message is not None]

    def _candidates(self, code: int) -> list[MessageLayout]:
        found = self._messages(code)
        if not found:
            raise _Refused(UNKNOWN_COMMAND, self.frame.id.at)
        self.likely = found[0]
        return found

    def _fitting(self, candidates: list[MessageLayout], length: int) -> list[MessageLayout]:
        fitting = [message for message in candidates if length in message.lengths]
        if not fitting:
            raise _Refused(LENGTH_MISMATCH, self.frame.length.at)
        return fitting

    def _field(self, placed: Placed, count: int) -> None:
        slot = placed.slot
        if isinstance(slot, Constant):
            self._constant(placed, slot)
        if not isinstance(slot, Number):
            return
        if slot.role == "count" and not slot.write(count).startswith(placed.of(self.data)):
            raise _Refused(COUNT_MISMATCH, placed.at)
        if not slot.low <= slot.read(self._whole(placed)) <= slot.high:
            raise _Refused(OUT_OF_RANGE, placed.at)
