"""What the head of a frame may belong to, as far as it tells by itself."""

from __future__ import annotations

from .envelope import Address, Constant, Id, Length
from .errors import Reason
from .trial import Known, Refused, Unknown, differs, too_short
from .verdict import Verdict

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import TypeAlias

    from .envelope import Envelope, Part
    from .message import Message

    Trial: TypeAlias = "Refused | Unknown | Known"


class HeadTrials:
    """What a head of one envelope may belong to: some messages, none of them larger than `largest`.

    It is made once for each envelope of a table. A line with noise on it shows a new head every few
    bytes, so that what ids and length lead to is worked out once for all heads.
    """

    def __init__(self, frame: Envelope, kinds: Sequence[type[Message]], largest: int) -> None:
        self.frame = frame
        if frame.length is None:
            kinds = [each for each in kinds if _least(each) <= largest]
        # The messages by the first of their ids, by the first two, and so on.
        begun: dict[tuple[int, ...], list[type[Message]]] = {(): [*kinds]}
        for kind in kinds:
            for size in range(1, len(frame.ids) + 1):
                begun.setdefault(kind.IDS[:size], []).append(kind)
        self._messages = {ids: _Sized(each, largest) for ids, each in begun.items()}
        # The lengths that there may be, and the part behind which length and ids are all known.
        self._lengths = range(frame.least - frame.uncounted, largest - frame.uncounted + 1)
        telling = [part for part in frame.head if isinstance(part, (Id, Length))]
        self._told = telling[-1] if frame.length is not None else None

    def of(self, head: bytes) -> list[Trial]:
        """Return all that a head may belong to; a refusal alone if it begins no message."""
        messages, length = self._messages, None
        ids: tuple[int, ...] = ()
        for part in self.frame.head:
            wrong = _wrong(part, head)
            if wrong is not None:
                return [Refused(wrong)]
            if isinstance(part, Id):
                ids += (part.read(head),)
                if ids not in messages:
                    return [self._unknown(part, head)]
            elif isinstance(part, Length):
                length = part.read(head)
                if length not in self._lengths:
                    return [_refused(Reason.LENGTH_MISMATCH, part)]
            if part is self._told and not messages[ids][length]:
                return [self._misfit(part)]
        return messages[ids][length]

    def _misfit(self, part: Part) -> Refused:
        """Return what refuses a length that no message with these ids has."""
        length = self.frame.length or part
        return Refused(Verdict(None, Reason.LENGTH_MISMATCH, length.at, part.at + part.size))

    def _unknown(self, part: Part, head: bytes) -> Trial:
        """Return what becomes of a head with an id, in this part, that no message has."""
        frame, reason = self.frame, Reason.UNKNOWN_COMMAND
        if len(head) < frame.body_at:
            # The length of what it claims is not known yet.
            proven = frame.proves_unknown
            return Refused(
                Verdict(None, reason, part.at, frame.body_at, is_open=True, proven=proven)
            )
        length = frame.length.read(head) if frame.length is not None else None
        claim = frame.size(length) if length is not None and length in self._lengths else 0
        if claim and frame.proves_unknown:
            return Unknown(frame, part.at, claim)
        return _refused(reason, part, claim)


class _Sized(dict["int | None", "list[Trial]"]):
    """The messages of some ids by the length that a head says, None where it says none."""

    def __init__(self, kinds: Sequence[type[Message]], largest: int) -> None:
        self._kinds = kinds
        self._largest = largest

    def __missing__(self, length: int | None) -> list[Trial]:
        trials: list[Trial] = [
            _known(kind, length, self._largest)
            for kind in self._kinds
            if length is None or length in kind.LENGTHS
        ]
        if trials:
            # Of others there may be as many as there are lengths.
            self[length] = trials
        return trials


def _known(kind: type[Message], length: int | None, largest: int) -> Known:
    shape = kind.SHAPE
    if length is not None:
        count = shape.counts[kind.LENGTHS.index(length)]
        return Known(kind, count, kind.FRAME.size(length), largest)
    if shape.counter is not None:
        return Known(kind, None, 0, largest)
    return Known(kind, shape.counts[0], _least(kind), largest)


def _wrong(part: Part, head: bytes) -> Verdict | None:
    """Return what is wrong with a part, whatever the others say; None if nothing is."""
    if isinstance(part, Constant):
        if head.startswith(part.data, part.at):
            return None
        return differs(part.data, head[part.place], Reason.BAD_HEADER, part.at, len(head))
    if part.at + part.size > len(head):
        return too_short(len(head), part.at + part.size)
    if isinstance(part, Address) and not part.is_right(head):
        return Verdict(None, Reason.OUT_OF_RANGE, part.at, part.at + part.size)
    return None


def _refused(reason: Reason, part: Part, claim: int = 0) -> Refused:
    return Refused(Verdict(None, reason, part.at, part.at + part.size, claim=claim))


def _least(kind: type[Message]) -> int:
    return kind.FRAME.size(kind.LENGTHS[0])
