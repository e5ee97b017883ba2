"""The walk through the head of a frame, part by part: which messages it may belong to."""

from __future__ import annotations

from .envelope import Address, Constant, Id, Length
from .errors import Reason
from .trial import Known, Refused, Unknown, differs, too_short
from .verdict import Verdict

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import TypeAlias

    from .envelope import Envelope, NumberPart, Part
    from .message import Message

    Trial: TypeAlias = "Refused | Unknown | Known"


class HeadWalk:
    """A walk through the head of one envelope, which leaves fewer and fewer of its messages."""

    def __init__(
        self, frame: Envelope, kinds: list[type[Message]], head: bytes, largest: int
    ) -> None:
        self.frame = frame
        self.kinds = kinds
        self.head = head
        self.largest = largest
        self.length: int | None = None
        self.ids_left = len(frame.ids)

    def trials(self) -> list[Trial]:
        """Return all that the head may belong to."""
        if self.frame.length is None:
            self.kinds = [each for each in self.kinds if _least(each) <= self.largest]
        for part in self.frame.head:
            refused = self._step(part)
            if refused is None and isinstance(part, (Id, Length)):
                refused = self._fitting(part)
            if refused is not None:
                return [refused]
        return [self._known(kind) for kind in self.kinds]

    def _known(self, kind: type[Message]) -> Known:
        shape = kind.SHAPE
        if self.length is not None:
            count = shape.counts[kind.LENGTHS.index(self.length)]
            return Known(kind, count, self.frame.size(self.length), self.largest)
        if shape.counter is not None:
            return Known(kind, None, 0, self.largest)
        return Known(kind, shape.counts[0], _least(kind), self.largest)

    def _step(self, part: Part) -> Trial | None:
        """Return what the head is if a part decides that."""
        found = self.head[part.place]
        if isinstance(part, Constant):
            if found == part.data:
                return None
            return Refused(differs(part.data, found, Reason.BAD_HEADER, part.at, len(self.head)))
        if len(found) < part.size:
            return Refused(too_short(len(self.head), part.at + part.size))
        return self._read(part)

    def _read(self, part: Part) -> Trial | None:
        """Return what the head is if a number in it decides that."""
        if isinstance(part, Id):
            return self._identified(part)
        if isinstance(part, Length):
            self.length = part.read(self.head)
            if not self._is_possible(self.length):
                return _refused(Reason.LENGTH_MISMATCH, part)
        elif isinstance(part, Address) and not part.holds(part.read(self.head)):
            return _refused(Reason.OUT_OF_RANGE, part)
        return None

    def _identified(self, part: NumberPart) -> Trial | None:
        number, which = part.read(self.head), len(self.frame.ids) - self.ids_left
        self.ids_left -= 1
        self.kinds = [kind for kind in self.kinds if kind.IDS[which] == number]
        return None if self.kinds else self._unknown(part)

    def _fitting(self, part: Part) -> Trial | None:
        """Keep the messages that can have the length, as soon as it and all ids are known."""
        if self.length is None or self.ids_left or self.frame.length is None:
            return None
        self.kinds = [kind for kind in self.kinds if self.length in kind.LENGTHS]
        if self.kinds:
            return None
        at, end = self.frame.length.at, max(part.place.stop, self.frame.length.place.stop)
        return Refused(Verdict(None, Reason.LENGTH_MISMATCH, at, end))

    def _unknown(self, part: Part) -> Trial:
        frame, reason = self.frame, Reason.UNKNOWN_COMMAND
        if len(self.head) < frame.body_at:
            # The length of what it claims is not known yet.
            proven = frame.proves_unknown
            return Refused(
                Verdict(None, reason, part.at, frame.body_at, is_open=True, proven=proven)
            )
        claim = 0
        if frame.length is not None:
            length = frame.length.read(self.head)
            claim = frame.size(length) if self._is_possible(length) else 0
        if claim and frame.proves_unknown:
            return Unknown(frame, part.at, claim)
        return _refused(reason, part, claim)

    def _is_possible(self, length: int) -> bool:
        return self.frame.least <= self.frame.size(length) <= self.largest


def _refused(reason: Reason, part: Part, claim: int = 0) -> Refused:
    return Refused(Verdict(None, reason, part.at, part.at + part.size, claim=claim))


def _least(kind: type[Message]) -> int:
    return kind.FRAME.size(kind.LENGTHS[0])
