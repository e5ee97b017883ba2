"""What keeps bytes from being a frame, in words."""

from __future__ import annotations

from .bytes_like import format_hex
from .errors import Reason
from .pluralize import describe_range, pluralize
from .trial import Known

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from .envelope import Envelope
    from .head_trials import Trial
    from .message import Message
    from .table import Table
    from .trial import Prove
    from .verdict import Verdict


class WhyNot:
    """The words for a verdict on one frame."""

    def __init__(self, table: Table, frame: bytes, verdict: Verdict, trials: list[Trial]) -> None:
        self._table = table
        self._frame = frame
        self._verdict = verdict
        self._trials = trials

    def words(self, prove: Prove) -> str:
        """Return what is wrong."""
        verdict = self._verdict
        if verdict.kind is not None:
            told = f"{_told(verdict.kind)} has {pluralize(verdict.size, 'byte')}"
            return f"{told}, not {len(self._frame)}"
        if verdict.offset < len(self._table.header):
            return self._opening()
        in_the_head = {
            Reason.BAD_HEADER: self._opening,
            Reason.UNKNOWN_COMMAND: self._ids,
            Reason.LENGTH_MISMATCH: self._lengths,
            Reason.OUT_OF_RANGE: self._address,
        }
        words = in_the_head.get(verdict.reason, str)()
        return words or self._behind_the_head(prove)

    def _behind_the_head(self, prove: Prove) -> str:
        frame, at = self._frame, self._verdict.offset
        for each in self._trials:
            found = each.judged(frame, 0, prove, 0)
            if isinstance(each, Known) and found.offset == at:
                return self._misfit(each, found, prove)
        least = min((envelope.least for envelope, _ in self._table.frames), default=0)
        return f"the shortest frame has {pluralize(least, 'byte')}"

    def _misfit(self, known: Known, verdict: Verdict, prove: Prove) -> str:
        kind, at, envelope = known.kind, verdict.offset, known.kind.FRAME
        name, found = kind.__name__, format_hex(self._frame[at : verdict.size])
        if verdict.reason is Reason.COUNT_MISMATCH:
            return self._count(known, at) or f"no {name} of this size has the count {found}"
        if verdict.reason is Reason.BAD_TRAILER:
            return f"a frame ends {format_hex(b''.join(part.data for part in envelope.ends))}"
        if verdict.reason is Reason.OUT_OF_RANGE:
            wrong = kind.SHAPE.out_of_range(self._frame, at)
            return wrong or f"{name} has other bytes than {found} there"
        if verdict.reason is Reason.BAD_CHECKSUM:
            return self._checksum(kind, verdict.size, prove)
        if envelope.length is not None:
            return f"{_told(kind)} has {pluralize(known.size, 'byte')}"
        return f"a frame of {name} like this has {pluralize(verdict.size, 'byte')}, or more"

    def _count(self, known: Known, at: int) -> str:
        """Return what the count at an offset must be; "" where only the count says the size."""
        if known.count is None:
            return ""
        for start, end, _, due in known.kind.SHAPE.places(known.count):
            if start == at and isinstance(due, bytes):
                found = format_hex(self._frame[at:end])
                return f"with this length the count is {format_hex(due)}, not {found}"
        return ""

    def _checksum(self, kind: type[Message], size: int, prove: Prove) -> str:
        frame, envelope = self._frame[:size], kind.FRAME
        part = prove(frame, 0, size, envelope, kind.IDS) or envelope.checksums[0]
        right = part.write(part.maker(kind.IDS, envelope.hidden)(frame))
        found = format_hex(frame[part.place])
        return f"the {part.name} is {found}, and these bytes have {format_hex(right)}"

    def _opening(self) -> str:
        openings = dict.fromkeys(_opening(frame) for frame, _ in self._table.frames)
        return f"a frame begins {' or '.join(openings)}"

    def _address(self) -> str:
        for envelope, _ in self._table.frames:
            part = envelope.address
            if part is not None and part.at == self._verdict.offset:
                number = part.read(self._frame)
                return f"{part.name} is {number}, outside {describe_range(part.numbers)}"
        return ""

    def _ids(self) -> str:
        """Return what ids there are, and which could be there."""
        for envelope, kinds in self._begun():
            parts = [part for part in envelope.ids if part.place.stop <= len(self._frame)]
            known = [_shown(ids) for ids in sorted({kind.IDS[: len(parts)] for kind in kinds})]
            if parts and parts[-1].at >= self._verdict.offset:
                names = " and ".join(part.name for part in parts)
                found = _shown([part.read(self._frame) for part in parts])
                return f"the {names} is {found}, and only {', '.join(known)} can be here"
        return "no message of this direction begins like that"

    def _lengths(self) -> str:
        """Return the lengths that could stand there."""
        for envelope, every in self._begun():
            part = envelope.length
            if part is None:
                continue
            names: dict[str, list[str]] = {}
            for kind in every:
                if self._is_told(envelope, kind):
                    names.setdefault(_lengths(kind.LENGTHS), []).append(kind.__name__)
            legal = " or ".join(f"{words} ({', '.join(who)})" for words, who in names.items())
            found = part.read(self._frame)
            return f"the {part.name} is {found}, and must be {legal or self._bounds(envelope)}"
        return "no message of this direction is that long"

    def _bounds(self, envelope: Envelope) -> str:
        """Return the lengths that frames of any message have."""
        least, most = (size - envelope.uncounted for size in (envelope.least, self._table.largest))
        return f"{least}..{most}" if self._table.is_bounded else f"at least {least}"

    def _is_told(self, envelope: Envelope, kind: type[Message]) -> bool:
        """Return whether the ids are all there, and those of a message."""
        if not envelope.ids or envelope.ids[-1].place.stop > len(self._frame):
            return False
        found = [part.read(self._frame) for part in envelope.ids]
        return [*kind.IDS[: len(found)]] == found

    def _begun(self) -> Iterable[tuple[Envelope, list[type[Message]]]]:
        frames = self._table.frames
        return [each for each in frames if each[0].begins(self._frame, 0)]


def _told(kind: type[Message]) -> str:
    """Return a message by what says how long its frame is."""
    if kind.FRAME.length is None:
        return f"this frame of {kind.__name__}"
    return f"{kind.__name__} with this length"


def _opening(envelope: Envelope) -> str:
    if envelope.header or not envelope.head:
        return format_hex(envelope.header) or "with its fields"
    return f"with its {envelope.head[0].name}"


def _shown(numbers: Sequence[int]) -> str:
    return " ".join(map(str, numbers))


def _lengths(lengths: Sequence[int]) -> str:
    if isinstance(lengths, range):
        return describe_range(lengths)
    return " or ".join(map(str, lengths))
