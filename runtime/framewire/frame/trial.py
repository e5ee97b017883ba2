"""What a head of a frame may belong to, and the trial of the bytes behind it."""

from __future__ import annotations

from functools import lru_cache
from itertools import takewhile

from .envelope import Constant
from .errors import Reason
from .verdict import Verdict

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from typing import TypeAlias

    from .envelope import Address, Checksum, Envelope
    from .message import Message

    # What tells the first wrong checksum of a frame of an envelope, by the ids of its message: from
    # where to where it stands in some bytes.
    Prove: TypeAlias = "Callable[[bytes, int, int, Envelope, Sequence[int]], Checksum | None]"
    # From where to where it stands, why it would be refused, and what must be there, or what tells
    # where its bytes are wrong.
    Place: TypeAlias = "tuple[int, int, Reason, bytes | Callable[[bytes], int | None]]"


# So many verdicts on wrong counts are remembered at once.
_REMEMBERED = 4096


class Refused:
    """A head that begins no message of an envelope, or is too short."""

    size = 0

    def __init__(self, verdict: Verdict) -> None:
        self.verdict = verdict

    def judged(self, _data: bytes, _at: int, _prove: Prove, _since: int) -> Verdict:
        """Return the verdict."""
        return self.verdict


class Unknown:
    """The head of a frame of unknown id, at `id_at`, that a checksum may prove: its `size`."""

    def __init__(self, frame: Envelope, id_at: int, size: int) -> None:
        self.frame = frame
        self.id_at = id_at
        self.size = size

    def judged(self, data: bytes, at: int, prove: Prove, _since: int) -> Verdict:
        """Judge the frame at data[at]."""
        is_open = len(data) - at < self.size
        proven = is_open or self._is_right(data[at : at + self.size], data, at, prove)
        reason, size = Reason.UNKNOWN_COMMAND, self.size
        return Verdict(None, reason, self.id_at, size, is_open=is_open, proven=proven)

    def _is_right(self, frame: bytes, data: bytes, at: int, prove: Prove) -> bool:
        right = self.frame.is_around(frame)
        return right and prove(data, at, self.size, self.frame, ()) is None


class Known:
    """The head of a message: its `size` and its count; 0 and None where only that count says."""

    def __init__(self, kind: type[Message], count: int | None, size: int, largest: int) -> None:
        self.kind = kind
        self.count = count
        self.size = size
        self.largest = largest
        self._few = None if count is None else kind.SHAPE.few_places(count)

    def judged(self, data: bytes, at: int, prove: Prove, since: int) -> Verdict:
        """Judge the frame at data[at], of which `since` bytes were judged before."""
        count, size = self.count, self.size
        if count is None:
            measured = self._measured(data, at, since)
            if isinstance(measured, Verdict):
                return measured
            count, size = measured
        places = self.kind.SHAPE.places(count, since) if self._few is None else self._few
        wrong = _misfit(places, data, at)
        if wrong is None and self.kind.FRAME.judged:
            wrong = _wrong_end(self.kind.FRAME, size, data, at)
        if wrong is not None:
            return wrong
        if len(data) - at < size:
            return too_short(len(data) - at, size)
        return self._proven(data, at, size, prove)

    def _measured(self, data: bytes, at: int, since: int) -> tuple[int, int] | Verdict:
        """Return the count of a frame that says no more of its length, and its size."""
        shape = self.kind.SHAPE
        start, end = shape.counter or (0, 0)
        before = takewhile(lambda place: place[0] < start, shape.places(shape.counts[0], since))
        wrong = _misfit(before, data, at)
        if wrong is not None:
            return wrong
        if len(data) - at < end:
            return too_short(len(data) - at, end)
        count = shape.count_of(data[at + start : at + end])
        if count is not None:
            size = shape.size_at(count)
            if size <= self.largest:
                return count, size
        return Verdict(None, Reason.COUNT_MISMATCH, start, end)

    def _proven(self, data: bytes, at: int, size: int, prove: Prove) -> Verdict:
        frame = self.kind.FRAME
        wrong = prove(data, at, size, frame, self.kind.IDS) if frame.checksums else None
        if wrong is not None:
            return Verdict(None, Reason.BAD_CHECKSUM, wrong.at % size, size)
        return Verdict(self.kind, Reason.TRAILING_BYTES, size, size)


def too_short(have: int, size: int) -> Verdict:
    """Return the verdict on `have` bytes that are legal, and judged further at `size` bytes."""
    return Verdict(None, Reason.TOO_SHORT, have, size, is_open=True)


def differs(due: bytes, found: bytes, reason: Reason, start: int, have: int) -> Verdict:
    """Return the verdict on bytes at `start` that are not those due, or not complete."""
    for at, byte in enumerate(found):
        if byte != due[at]:
            return Verdict(None, reason, start + at, start + at + 1)
    return too_short(have, max(have, start) + 1)


# In noise, the same again and again.
@lru_cache(maxsize=_REMEMBERED)
def _miscounted(start: int, due: bytes, found: bytes) -> Verdict:
    """Return the verdict on the bytes of a count that are not those due."""
    verdict = differs(due, found, Reason.COUNT_MISMATCH, start, 0)
    verdict.offset = start
    return verdict


def _misfit(places: Iterable[Place], data: bytes, at: int) -> Verdict | None:
    """Return the verdict on the first place of the frame at `at` that is wrong, or not complete."""
    for start, end, reason, due in places:
        found = data[at + start : at + end]
        if isinstance(due, bytes):
            if found != due:
                if reason is Reason.COUNT_MISMATCH and not due.startswith(found):
                    return _miscounted(start, due, found)
                return differs(due, found, reason, start, len(data) - at)
        elif len(found) < end - start:
            return too_short(len(data) - at, end)
        else:
            bad = due(found)
            if bad is not None:
                return Verdict(None, reason, start + bad, end)
    return None


def _wrong_end(frame: Envelope, size: int, data: bytes, at: int) -> Verdict | None:
    """Return the verdict on what stands behind the fields, save for checksums."""
    for part in frame.judged:
        start = size + part.at
        found = data[at + start : at + start + part.size]
        if isinstance(part, Constant):
            if found != part.data:
                return differs(part.data, found, Reason.BAD_TRAILER, start, len(data) - at)
        elif len(found) < part.size:
            return too_short(len(data) - at, start + part.size)
        elif not _is_address(part, found):
            return Verdict(None, Reason.OUT_OF_RANGE, start, start + part.size)
    return None


def _is_address(part: Address, found: bytes) -> bool:
    return part.holds(int.from_bytes(found, part.order))
