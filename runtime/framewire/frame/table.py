"""The first bytes of legal frames, by message, and why others begin none.

The bytes are tested in the order in which they come, and the first that no legal frame can have
gives the reason and the place; a checksum is the last test. Single frames and streams are judged by
this alone.
"""

from __future__ import annotations

from .bytes_like import as_bytes
from .envelope import Constant
from .errors import DecodeError, Reason
from .head_trials import HeadTrials
from .quick_tests import together
from .trial import Known, Refused, too_short
from .verdict import Verdict

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any, TypeAlias

    from .envelope import Address, Checksum, Envelope
    from .head_trials import Trial
    from .heads import Heads
    from .message import Message
    from .trial import Prove

    # The size of the frame, 0 where only its count says it; from where to where that count stands,
    # and the bytes it must be (b"" at 0:0 if there is none); the class; what says of a whole frame
    # whether all the rest of it is right but for what it adds up to (None if it always is); and the
    # entry for another message with the same head.
    Entry: TypeAlias = (
        "tuple[int, int, int, bytes, type[Message], Callable[[bytes], bool] | None, Entry | None]"
    )


_new = object.__new__

ANY_SIZE = 1 << 62
"""The largest frame of a table without a bound."""

# So many heads and beginnings are remembered at once: more than any protocol's traffic has, and
# noise must not fill the memory.
_REMEMBERED = 4096

_NOTHING = Verdict(None, Reason.BAD_HEADER, 0, 1)


class Table(dict[bytes, "Entry"]):
    """A map from the head of a frame to what must follow for it to be legal.

    It learns heads as they come, of `head_size` bytes; `weigh` judges all that are not in it. No
    frame is larger than `largest`, and `heads` are those of all frames of the protocol. Beginnings
    that are remembered have at most `remembered` bytes. `header` is that of all its frames, b""
    where they do not have the same, and `begun` are its beginnings, the longest first. If it is one
    byte, or repeats one, `run` is a head of this byte alone, and `run_claim` what it claims as a
    frame of unknown command, -1 if it does not: each byte of a longer run begins another.
    """

    __slots__ = (
        "_has_checksums",
        "_heads",
        "_trials",
        "begun",
        "frames",
        "head",
        "head_size",
        "header",
        "heads",
        "largest",
        "messages",
        "reach",
        "remembered",
        "run",
        "run_claim",
        "total",
        "verdicts",
        "waits",
    )

    def __init__(self, messages: Sequence[type[Message]], largest: int, heads: Heads) -> None:
        super().__init__()
        self.heads = heads
        # Its own: they are looked up for every frame.
        self.head_size = heads.longest
        self.total = heads.total
        # Made once: making it takes as long as using it.
        self.head = slice(self.head_size)
        self.remembered = heads.longest + 1
        self.messages = messages
        self.largest = largest
        # The envelopes that there may be, each with its messages.
        every = [
            (frame, [each for each in messages if each.FRAME is frame]) for frame in heads.envelopes
        ]
        # Where nothing is sent, bytes may still begin as any frame does.
        self.frames = [
            (frame, kinds)
            for frame, kinds in every
            if not messages or (kinds and frame.least <= largest)
        ]
        self._has_checksums = any(frame.checksums for frame, _ in self.frames)
        self._heads = [HeadTrials(frame, kinds, largest) for frame, kinds in self.frames]
        headers = {frame.header for frame, _ in self.frames}
        self.header = headers.pop() if len(headers) == 1 else b""
        # How many bytes of an illegal frame may look legal, where no checksum proves it.
        self.reach = max((_reach(kind, largest) for kind in messages), default=0)
        # What the heads seen so far may belong to; the verdicts on those that decide alone.
        self._trials: dict[bytes, list[Trial]] = {}
        self.verdicts: dict[bytes, Verdict] = {}
        # The beginnings of frames seen so far, and the size at which each can be judged further.
        self.waits: dict[bytes, int] = {}
        self.begun = tuple(self.header[:size] for size in range(len(self.header), 0, -1))
        self.run = b"" if self.header.strip(self.header[:1]) else self.header[:1] * self.head_size
        self.run_claim = self._claim_of_run()

    def weigh(
        self,
        data: bytes,
        at: int = 0,
        prove: Prove | None = None,
        since: int = 0,
        *,
        quiet: bool = False,
    ) -> Verdict:
        """Judge the frame that begins at `at`; `data` may go on behind it.

        If they may be one of several messages, it is the longest that is legal; if none is, the
        refusal at the last byte is returned. As long as a longer frame may come, the verdict is
        open, unless the line is `quiet`. `prove` tells wrong checksums, and `since` bytes of the
        frame were judged before.
        """
        head = data[at : at + self.head_size]
        verdict = self.verdicts.get(head)
        if verdict is not None:
            return verdict
        trials = self._trials.get(head) or self._learn(head)
        if len(trials) == 1:
            return trials[0].judged(data, at, prove or wrong_checksum, since)
        verdict = chosen([each.judged(data, at, prove or wrong_checksum, 0) for each in trials])
        return verdict.whole or verdict if quiet else verdict

    def whole(self, head: bytes, data: bytes, at: int) -> tuple[int, type[Message]] | None:
        """Return size and class of a message that is whole at data[at], if its head tells that.

        What a checksum proves is left to `weigh`, and so is a frame whose count says its size.
        """
        entry = None if self._has_checksums else self.get(head)
        while entry is not None:
            size, start, end, count, kind, holds, entry = entry
            if (
                at + size <= len(data)
                and (not count or data[at + start : at + end] == count)
                and (holds is None or holds(data[at : at + size]))
            ):
                return (size, kind) if size else None
        return None

    @property
    def is_bounded(self) -> bool:
        """Whether there is a size above which no frame is."""
        return self.largest < ANY_SIZE

    def begins(self, data: bytes, at: int) -> bool:
        """Return whether a frame may begin at data[at], as far as its header goes."""
        if self.header:
            return data.startswith(self.header, at)
        return any(frame.begins(data, at) for frame, _ in self.frames)

    def next_begun(self, data: bytes, at: int) -> int:
        """Return where from data[at] on a frame may begin, of whose header not all is there.

        That is the end if nowhere. If the frames do not all have the same header, it may be there.
        """
        if not self.header:
            return self.heads.next_begun(data, at)
        if data.endswith(self.begun, at):
            for begun in self.begun:
                if data.endswith(begun, at):
                    return len(data) - len(begun)
        return len(data)

    def wait(self, beginning: bytes, size: int) -> None:
        """Remember at which size the beginning of a frame can be judged further."""
        _remember(self.waits, beginning, size)

    def read(self, frame: bytes | bytearray | memoryview) -> Message:
        """Return the message of `frame`, with nothing after it. Raises DecodeError."""
        if type(frame) is not bytes:
            frame = as_bytes(frame)
        message = self.find(frame)
        if message is None:
            raise self.error(frame, self.weigh(frame, quiet=True))
        return message

    def find(self, frame: bytes) -> Message | None:
        """Return the message of `frame`, with nothing after it; None if there is none."""
        kind = self._seen(frame)
        if kind is None:
            verdict = self.weigh(frame, quiet=True)
            kind = verdict.kind
            if kind is None or verdict.size != len(frame):
                return None
        message = _new(kind)
        message._frame = frame
        return message

    def _seen(self, frame: bytes) -> type[Message] | None:
        """Return the message of `frame`, by an entry for its head; None if none says so."""
        entry = self.get(frame[: self.head_size])
        if entry is not None and not entry[0]:
            entry = measured(entry, frame, 0)
        if entry is None:
            return None
        size, at, until, count, kind, holds, _ = entry
        if len(frame) != size or (count and frame[at:until] != count):
            return None
        if holds is not None and not holds(frame):
            return None
        total = self.total
        return kind if total is None or sum(frame) & 0xFF == total else None

    def all_of(self, frame: bytes) -> list[type[Message]]:
        """Return every message that a whole frame may be."""
        trials = self._trials_of(frame[: self.head_size])
        found = (each.judged(frame, 0, wrong_checksum, 0) for each in trials)
        return [each.kind for each in found if each.kind is not None and each.size == len(frame)]

    def awaited(self, data: bytes) -> list[type[Message] | None]:
        """Return the messages that more bytes may make of these; None stands for unknown ones."""
        return [
            each.kind if isinstance(each, Known) else None
            for each in self._trials_of(data[: self.head_size])
            if each.judged(data, 0, wrong_checksum, 0).is_open
        ]

    def error(self, frame: bytes, verdict: Verdict) -> DecodeError:
        """Return the error for `frame`, by its verdict."""
        from .why_not import WhyNot

        why_not = WhyNot(self, frame, verdict, self._trials_of(frame[: self.head_size]))
        return DecodeError(verdict.reason, verdict.offset, why_not.words(wrong_checksum))

    def _trials_of(self, head: bytes) -> list[Trial]:
        return self._trials.get(head) or self._learn(head)

    def _learn(self, head: bytes) -> list[Trial]:
        """Return what a head may belong to, and remember it."""
        trials = self._walked(head)
        refused = [each for each in trials if isinstance(each, Refused)]
        if len(refused) == len(trials):
            _remember(self.verdicts, head, chosen([each.verdict for each in refused]))
            return trials
        _remember(self._trials, head, trials)
        if len(head) == self.head_size and not any(each.verdict.is_open for each in refused):
            entry = self._entry([each for each in trials if not isinstance(each, Refused)])
            if entry is not None:
                _remember(self, head, entry)
        return trials

    def _claim_of_run(self) -> int:
        """Return what a head that is a run of the header's byte claims, if that alone decides."""
        trials = self._walked(self.run) if self.run else []
        claims = [each.verdict.claim for each in trials if isinstance(each, Refused)]
        return claims[0] or -1 if len(claims) == len(trials) == 1 else -1

    def _walked(self, head: bytes) -> list[Trial]:
        """Return what a head may belong to, of any envelope."""
        found: list[Trial] = []
        if not head:
            return [Refused(too_short(0, 1))]
        if head[0] in self.heads.first_bytes:
            for frame in self._heads:
                found += frame.of(head)
        return found or [Refused(_NOTHING)]

    def _entry(self, trials: Sequence[Trial]) -> Entry | None:
        """Return the entries of the messages that a head may belong to, those of the longest frame.

        None where only `weigh` can tell: a size is not known, or an unknown frame may be longer.
        """
        known = [each for each in trials if isinstance(each, Known)]
        size = max((each.size for each in trials), default=0)
        if size not in {each.size for each in known}:
            return None
        if any(not each.size and self._may_grow(each, len(trials)) for each in known):
            return None
        entry: Entry | None = None
        # The last first: each is put in front of the others.
        for each in reversed([each for each in known if each.size == size]):
            kind = each.kind
            holds = together([*_tests(kind), *self._proofs(kind)])
            entry = (each.size, *_counted(kind, each.count), kind, holds, entry)
        return entry

    def _proofs(self, kind: type[Message]) -> list[Callable[[bytes], bool]]:
        """Return what says whether the checksums of a message are right, but for a mere total."""
        heads = self.heads
        if self.total is not None:
            return []
        return kind.FRAME.provers(kind.IDS) if heads.proves is None else [heads.proves]

    def _may_grow(self, each: Known, trials: int) -> bool:
        """Return whether a frame whose count says its size may be another, or be too large."""
        return trials > 1 or largest_of([each.kind]) > self.largest


def largest_of(messages: Sequence[type[Message]]) -> int:
    """Return the size of the largest frame of these messages; 0 where there are none."""
    return max((kind.FRAME.size(kind.LENGTHS[-1]) for kind in messages), default=0)


def is_certain(kind: type[Message]) -> bool:
    """Return whether nothing but its checksum can be wrong behind the head and count of a frame."""
    return kind.SHAPE.certain and not kind.FRAME.judged


def measured(entry: Entry, data: bytes, at: int) -> Entry | None:
    """Return the entry of a frame whose count says its size; None if there is none."""
    size, start, end, _, kind, holds, other = entry
    if size or at + end > len(data):
        return None
    size = kind.SHAPE.sizes[data[at + start : at + end]]
    return (size, 0, 0, b"", kind, holds, other) if size else None


def chosen(verdicts: Sequence[Verdict]) -> Verdict:
    """Return the verdict on bytes by those of all that they may be.

    It is open as long as one of them is, so that it makes no difference how they arrive. Of frames
    that are there, it is the longest: it may begin as a shorter one by chance.
    """
    decided = [each for each in verdicts if not each.is_open and (each.kind or each.proven)]
    # For one of unknown id alone, nothing is awaited that could not prove it.
    waiting = [
        each
        for each in verdicts
        if each.is_open and (each.proven or each.reason is Reason.TOO_SHORT)
    ]
    if len(waiting) == 1 and not decided:
        return waiting[0]
    whole = max(decided, key=lambda each: (each.size, each.kind is not None), default=None)
    if not waiting:
        return whole or max(verdicts, key=lambda each: each.offset)
    last = max(waiting, key=lambda each: each.offset)
    size = min(each.size for each in waiting)
    proven = any(each.proven for each in waiting)
    return Verdict(None, last.reason, last.offset, size, is_open=True, proven=proven, whole=whole)


def wrong_checksum(
    data: bytes, at: int, size: int, frame: Envelope, ids: Sequence[int]
) -> Checksum | None:
    """Return the first wrong checksum of the frame at data[at]."""
    return frame.wrong(data[at : at + size], ids)


def _counted(kind: type[Message], count: int | None) -> tuple[int, int, bytes]:
    """Return where the count of a message stands, from and to, and its bytes if it is known."""
    if kind.SHAPE.counter is None:
        return 0, 0, b""
    start, end = kind.SHAPE.counter
    if count is None:
        # No count is like that, so that it is looked at: see `measured`.
        return start, end, bytes(end - start + 1)
    due = next(place[3] for place in kind.SHAPE.places(count) if place[0] == start)
    return start, end, due if isinstance(due, bytes) else b""


def _tests(kind: type[Message]) -> list[Callable[[bytes], bool]]:
    """Return what says of a frame of a message's size whether it is right, but for its checksums.

    Its head and its count are what led to the message.
    """
    return [*kind.SHAPE.tests, *map(_end_test, kind.FRAME.judged)]


def _end_test(part: Constant | Address) -> Callable[[bytes], bool]:
    """Return what says whether a constant or an address behind the fields is right."""
    if isinstance(part, Constant):
        place, due = part.place, part.data
        return lambda frame: frame[place] == due
    return part.is_right


def _reach(kind: type[Message], largest: int) -> int:
    """Return how many bytes of an illegal frame may look like those of a message."""
    if not is_certain(kind) or kind.FRAME.checksums:
        return largest
    return kind.SHAPE.counter[1] if kind.SHAPE.counter else kind.FRAME.body_at


def _remember(known: dict[bytes, Any], key: bytes, value: Any) -> None:
    """Remember a value; if too many are known, forget the others."""
    if len(known) >= _REMEMBERED:
        known.clear()
    known[key] = value
