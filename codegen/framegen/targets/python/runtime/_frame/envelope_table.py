"""The first bytes of legal frames, by message, and why others begin none.

The bytes are tested in the order in which they come, and the first that no legal frame can have
gives the reason and the place; a checksum is the last test. Single frames and streams are judged by
this alone.
"""

from __future__ import annotations

from .bytes_like import as_bytes, format_hex
from .direction import Direction
from .envelope import Address, Constant, Id, Length
from .envelopes import ENVELOPES
from .errors import DecodeError, Reason
from .heads import FIRST_BYTES, HEAD, size_of
from .pluralize import describe_range
from .verdict import Verdict

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from typing import Any, Literal, TypeAlias

    from .envelope import Checksum, Envelope, NumberPart, Part
    from .message import Message

    # The size of the frame, 0 where its count says it; from where to where that count stands, and
    # the bytes it must be (b"" at 0:0 if there is none to be looked at); the class; what says of a
    # whole frame whether all else is right; and the entry for another message with the same head.
    Entry: TypeAlias = (
        "tuple[int, int, int, bytes, type[Message], Callable[[bytes], bool], Entry | None]"
    )
    # What a head may belong to: a message with its count and its size, None and 0 where these are
    # not known yet; or a frame of unknown id that a checksum may prove, with its size and the place
    # of that id. Otherwise the head alone is refused, or too short.
    Try: TypeAlias = "Verdict | tuple[type[Message], int | None, int] | tuple[Envelope, int, int]"
    # What tells the first wrong checksum of a frame of an envelope, by the ids of its message.
    Prove: TypeAlias = "Callable[[bytes, int, int, Envelope, Sequence[int]], Checksum | None]"


_new = object.__new__

ANY_SIZE = 1 << 62
"""The largest frame of a table without a bound."""

# So many heads and beginnings are remembered at once: more than any protocol's traffic has, and
# noise must not fill the memory.
_REMEMBERED = 4096


class Table(dict[bytes, "Entry"]):
    """A map from the head of a frame to what must follow for it to be legal.

    It learns heads as they come; `weigh` judges all that are not in it. No frame is larger than
    `largest`.
    """

    def __init__(self, messages: Sequence[type[Message]], largest: int) -> None:
        super().__init__()
        self.messages = messages
        self.largest = largest
        # The envelopes that there may be, each with its messages, one direction after the other.
        self.frames: list[tuple[Envelope, list[type[Message]]]] = []
        ways = list(Direction)
        messages = sorted(messages, key=lambda kind: ways.index(kind.DIRECTION))
        for frame in ENVELOPES:
            kinds = [kind for kind in messages if kind.FRAME is frame]
            if kinds and frame.least <= largest:
                self.frames.append((frame, kinds))
        # How many bytes of an illegal frame may look legal, where no checksum proves it.
        self.reach = max((_reach(kind, largest) for kind in messages), default=0)
        # What the heads seen so far may belong to; the verdicts on those that decide alone.
        self._tries: dict[bytes, list[Try]] = {}
        self.verdicts: dict[bytes, Verdict] = {}
        # The beginnings of frames seen so far, and the size at which each can be judged further.
        self.waits: dict[bytes, int] = {}

    def weigh(
        self, data: bytes, at: int = 0, prove: Prove | None = None, since: int = 0
    ) -> Verdict:
        """Judge the frame that begins at `at`; `data` may go on behind it.

        If they may be one of several messages, it is the smallest that is legal; if none is, the
        refusal at the last byte is returned. `prove` tells wrong checksums, and `since` bytes of
        the frame were judged before.
        """
        head = data[at : at + HEAD]
        verdict = self.verdicts.get(head)
        if verdict is not None:
            return verdict
        tries = self._tries.get(head)
        if tries is None:
            tries = self._learn(head)
            if not tries or all(isinstance(each, Verdict) for each in tries):
                verdict = _chosen([each for each in tries if isinstance(each, Verdict)])
                _remember(self.verdicts, head, verdict)
                return verdict
        if len(tries) == 1:
            return self._judged(tries[0], data, at, prove or _wrong, since)
        return _chosen([self._judged(each, data, at, prove or _wrong, 0) for each in tries])

    def begins(self, data: bytes, at: int) -> bool:
        """Return whether a frame may begin at data[at], as far as its header goes."""
        return any(frame.begins(data, at) for frame, _ in self.frames)

    def wait(self, beginning: bytes, size: int) -> None:
        """Remember at which size the beginning of a frame can be judged further."""
        _remember(self.waits, beginning, size)

    def read(self, frame: bytes | bytearray | memoryview) -> Message:
        """Return the message of `frame`, with nothing after it. Raises DecodeError."""
        if type(frame) is not bytes:
            frame = as_bytes(frame)
        message = self.find(frame)
        if message is None:
            raise self.error(frame, self.weigh(frame))
        return message

    def find(self, frame: bytes) -> Message | None:
        """Return the message of `frame`, with nothing after it; None if there is none."""
        verdict = self.weigh(frame)
        kind = verdict.kind
        if kind is None or verdict.size != len(frame):
            return None
        message = _new(kind)
        message._frame = frame
        return message

    def all_of(self, frame: bytes) -> list[type[Message]]:
        """Return every message that a whole frame may be."""
        self.weigh(frame)
        found = []
        for each in self._tries.get(frame[:HEAD], ()):
            verdict = self._judged(each, frame, 0, _wrong, 0)
            if verdict.kind is not None and verdict.size == len(frame):
                found.append(verdict.kind)
        return found

    def error(self, frame: bytes, verdict: Verdict) -> DecodeError:
        """Return the error for `frame`, by its verdict."""
        return DecodeError(verdict.reason, verdict.offset, self._problem(frame, verdict))

    # Heads.

    def _learn(self, head: bytes) -> list[Try]:
        """Return what a new head may belong to, and remember it."""
        if not head:
            return [_too_short(0, 1)]
        if head[0] not in FIRST_BYTES:
            return [_NOTHING]
        tries = [each for frame, kinds in self.frames for each in self._walked(frame, kinds, head)]
        if all(isinstance(each, Verdict) for each in tries):
            return tries
        _remember(self._tries, head, tries)
        entry = self._entry(tries) if len(head) == HEAD else None
        if entry is not None:
            _remember(self, head, entry)
        return tries

    def _entry(self, tries: list[Try]) -> Entry | None:
        """Return the entries of the messages that a head may belong to, the smallest first.

        None where not all of their sizes are known, or where something else may be smaller.
        """
        found = [each for each in tries if not isinstance(each, Verdict)]
        if len(found) > 1 and not all(size for *_, size in found):
            return None
        if any(isinstance(kind, type) and largest_of([kind]) > self.largest for kind, *_ in found):
            return None
        if any(
            each.is_open and each.reason is Reason.TOO_SHORT
            for each in tries
            if isinstance(each, Verdict)
        ):
            return None
        entry: Entry | None = None
        for each in reversed(sorted(found, key=_size_of_try)):
            if isinstance(each[0], type):
                kind, count, size = each
                entry = (size, *_counted(kind, count), kind, _holds(kind), entry)
            elif entry is not None:
                return None
        return entry

    def _walked(self, frame: Envelope, kinds: list[type[Message]], head: bytes) -> list[Try]:
        """Return what a head may belong to, of one envelope."""
        length: int | None = None
        ids_left = len(frame.ids)
        if frame.length is None:
            kinds = [kind for kind in kinds if size_of(kind, kind.LENGTHS[0]) <= self.largest]
        for part in frame.head:
            found = head[part.place]
            if isinstance(part, Constant):
                if found != part.data:
                    return [_differs(part, found, Reason.BAD_HEADER, part.at, len(head))]
            elif len(found) < part.size:
                return [_too_short(len(head), part.at + part.size)]
            elif isinstance(part, Length):
                length = part.read(head)
                if not self._is_possible(frame, length):
                    return [_refused(Reason.LENGTH_MISMATCH, part)]
            elif isinstance(part, Id):
                number, which = part.read(head), len(frame.ids) - ids_left
                ids_left -= 1
                kinds = [kind for kind in kinds if kind.IDS[which] == number]
                if not kinds:
                    return [self._unknown(frame, part, head)]
            elif isinstance(part, Address) and not part.holds(part.read(head)):
                return [_refused(Reason.OUT_OF_RANGE, part)]
            if length is not None and not ids_left and frame.length is not None:
                kinds = [kind for kind in kinds if length in kind.LENGTHS]
                if not kinds:
                    end = max(part.at + part.size, frame.length.at + frame.length.size)
                    return [Verdict(None, Reason.LENGTH_MISMATCH, frame.length.at, end)]
        if length is None:
            return [(kind, *_fixed(kind)) for kind in kinds]
        size = frame.size(length)
        return [(kind, kind.SHAPE.counts[kind.LENGTHS.index(length)], size) for kind in kinds]

    def _unknown(self, frame: Envelope, part: Part, head: bytes) -> Try:
        """Return what may become of a head whose id is unknown."""
        if len(head) < frame.body_at:
            # The length of what it claims is not known yet.
            reason = Reason.UNKNOWN_COMMAND
            proven = frame.proves_unknown
            return Verdict(None, reason, part.at, frame.body_at, is_open=True, proven=proven)
        claim = 0
        if frame.length is not None:
            length = frame.length.read(head)
            claim = frame.size(length) if self._is_possible(frame, length) else 0
        if claim and frame.proves_unknown:
            return frame, part.at, claim
        return _refused(Reason.UNKNOWN_COMMAND, part, claim)

    def _is_possible(self, frame: Envelope, length: int) -> bool:
        return frame.least <= frame.size(length) <= self.largest

    # What follows them.

    def _judged(self, each: Try, data: bytes, at: int, prove: Prove, since: int) -> Verdict:
        """Return the verdict on the frame at `at` as one of those that its head may belong to."""
        if isinstance(each, Verdict):
            return each
        first, second, size = each
        if isinstance(first, type):
            return self._fit(first, second, size, data, at, prove, since)
        return _proven(first, second or 0, size, data, at, prove)

    def _fit(
        self,
        kind: type[Message],
        count: int | None,
        size: int,
        data: bytes,
        at: int,
        prove: Prove,
        since: int,
    ) -> Verdict:
        """Judge the bytes behind a legal head at `at`, as a message."""
        shape, frame, have = kind.SHAPE, kind.FRAME, len(data) - at
        if count is None:
            start, end = shape.counter or (0, 0)
            for place in shape.places(shape.counts[0], since):
                if place[0] >= start:
                    break
                verdict = _misfit(place, data, at)
                if verdict is not None:
                    return verdict
            if have < end:
                return _too_short(have, end)
            count = shape.count_of(data[at + start : at + end])
            if count is not None:
                size = size_of(kind, kind.LENGTHS[shape.counts.index(count)])
            if count is None or size > self.largest:
                return Verdict(None, Reason.COUNT_MISMATCH, start, end)
        for place in shape.places(count, since):
            verdict = _misfit(place, data, at)
            if verdict is not None:
                return verdict
        for part in frame.judged:
            start = size + part.at
            found = data[at + start : at + start + part.size]
            if isinstance(part, Constant):
                if found != part.data:
                    return _differs(part, found, Reason.BAD_TRAILER, start, have)
            elif len(found) < part.size:
                return _too_short(have, start + part.size)
            elif not part.holds(int.from_bytes(found, part.order)):
                return Verdict(None, Reason.OUT_OF_RANGE, start, start + part.size)
        if have < size:
            return _too_short(have, size)
        wrong = prove(data, at, size, frame, kind.IDS) if frame.checksums else None
        if wrong is not None:
            return Verdict(None, Reason.BAD_CHECKSUM, wrong.at % size, size)
        return Verdict(kind, Reason.TRAILING_BYTES, size, size)

    # Words.

    def _problem(self, frame: bytes, verdict: Verdict) -> str:
        """Return what is wrong with an illegal frame, in words."""
        if verdict.kind is not None:
            name, size = verdict.kind.__name__, verdict.size
            return f"this frame of {name} has {size} bytes, not {len(frame)}"
        reason, at = verdict.reason, verdict.offset
        if reason is Reason.BAD_HEADER:
            return self._opening()
        if reason is Reason.UNKNOWN_COMMAND:
            return self._ids(frame)
        if reason is Reason.LENGTH_MISMATCH:
            return self._lengths(frame)
        for envelope, _ in self.frames:
            for part in envelope.head:
                if isinstance(part, Address) and reason is Reason.OUT_OF_RANGE and part.at == at:
                    number = part.read(frame)
                    return f"{part.name} is {number}, outside {describe_range(part.numbers)}"
        for each in self._tries.get(frame[:HEAD], ()):
            found = self._judged(each, frame, 0, _wrong, 0)
            if isinstance(each, tuple) and isinstance(each[0], type) and found.offset == at:
                return self._misfit_of(frame, found, each[0])
        return self._least()

    def _misfit_of(self, frame: bytes, verdict: Verdict, kind: type[Message]) -> str:
        """Return what keeps `frame` from being the message whose head it has, in words."""
        name, at, envelope = kind.__name__, verdict.offset, kind.FRAME
        if verdict.reason is Reason.OUT_OF_RANGE:
            found = kind.SHAPE.out_of_range(frame)
            return f"{name} has other bytes there" if found is None else found[1]
        if verdict.reason is Reason.COUNT_MISMATCH:
            return f"no {name} of this size has this count: {format_hex(frame[at : verdict.size])}"
        if verdict.reason is Reason.BAD_TRAILER:
            return f"a frame ends {format_hex(b''.join(part.data for part in envelope.ends))}"
        if verdict.reason is Reason.BAD_CHECKSUM:
            wrong = _wrong(frame, 0, verdict.size, envelope, kind.IDS)
            if wrong is not None:
                right = wrong.write(wrong.maker(kind.IDS, envelope.hidden)(frame[: verdict.size]))
                found_bytes = format_hex(frame[: verdict.size][wrong.place])
                return f"the {wrong.name} is {found_bytes}, and must be {format_hex(right)}"
        return f"{name} has {verdict.size} bytes" if verdict.size > len(frame) else self._least()

    def _opening(self) -> str:
        headers = dict.fromkeys(format_hex(frame.header) for frame, _ in self.frames)
        return f"a frame begins {' or '.join(headers)}"

    def _least(self) -> str:
        least = min((frame.least for frame, _ in self.frames), default=0)
        return f"the shortest frame has {least} bytes"

    def _ids(self, frame: bytes) -> str:
        for envelope, kinds in self.frames:
            if envelope.ids and envelope.begins(frame, 0) and len(frame) >= envelope.body_at:
                known = ", ".join(
                    dict.fromkeys(_shown(kind.IDS[: len(envelope.ids)]) for kind in kinds)
                )
                found = [part.read(frame) for part in envelope.ids]
                names = " and ".join(part.name for part in envelope.ids)
                return f"the {names} is {_shown(found)}, and only {known} can be here"
        return "no message begins like that"

    def _lengths(self, frame: bytes) -> str:
        """Return the lengths that could stand there, in words."""
        for envelope, every in self.frames:
            part = envelope.length
            if part is None or not envelope.begins(frame, 0):
                continue
            whole = len(frame) >= envelope.body_at
            found = tuple(each.read(frame) for each in envelope.ids) if whole else None
            names: dict[str, list[str]] = {}
            for kind in every:
                if kind.IDS[: len(envelope.ids)] == found:
                    names.setdefault(_words(kind.LENGTHS), []).append(kind.__name__)
            legal = " or ".join(f"{words} ({', '.join(who)})" for words, who in names.items())
            least, most = envelope.least - envelope.uncounted, self.largest - envelope.uncounted
            if not legal:
                legal = f"at least {least}" if self.largest == ANY_SIZE else f"{least}..{most}"
            return f"the {part.name} is {part.read(frame)}, and must be {legal}"
        return "no message is that long"


def largest_of(messages: Sequence[type[Message]]) -> int:
    """Return the size of the largest frame of these messages; 0 where there are none."""
    return max((size_of(kind, kind.LENGTHS[-1]) for kind in messages), default=0)


def found_entry(verdict: Verdict) -> Entry:
    """Return the entry of a message that is found."""
    kind = verdict.kind
    if kind is None:
        raise AssertionError("no message is found")
    return verdict.size, 0, 0, b"", kind, _always, None


def is_certain(kind: type[Message]) -> bool:
    """Return whether nothing but its checksum can be wrong behind the head and count of a frame."""
    return kind.SHAPE.certain and not kind.FRAME.judged


def measured(kind: type[Message], count: bytes) -> int:
    """Return the size of a frame by the bytes of its count; 0 if that is too short, or wrong."""
    shape = kind.SHAPE
    start, end = shape.counter or (0, 0)
    number = shape.count_of(count) if len(count) == end - start else None
    if number is None:
        return 0
    return size_of(kind, kind.LENGTHS[shape.counts.index(number)])


def _chosen(verdicts: list[Verdict]) -> Verdict:
    """Return the verdict on bytes by those of all that they may be.

    What is decided is so for the smallest frame, so that it makes no difference what has come
    behind it. Otherwise it is open as long as one of them is.
    """
    decided = [each for each in verdicts if not each.is_open and (each.kind or each.proven)]
    if decided:
        return min(decided, key=lambda each: (each.size, each.kind is None))
    waiting = [each for each in verdicts if each.is_open]
    if not waiting:
        return max(verdicts, key=lambda each: each.offset, default=_NOTHING)
    last = max(waiting, key=lambda each: each.offset)
    size = min(each.size for each in waiting)
    proven = any(each.proven for each in waiting)
    return Verdict(None, last.reason, last.offset, size, is_open=True, proven=proven)


def _refused(reason: Reason, part: Part, claim: int = 0) -> Verdict:
    return Verdict(None, reason, part.at, part.at + part.size, claim=claim)


def _too_short(have: int, size: int) -> Verdict:
    """Return the verdict on `have` bytes that are legal, and judged further at `size` bytes."""
    return Verdict(None, Reason.TOO_SHORT, have, size, is_open=True)


def _differs(part: Constant, found: bytes, reason: Reason, start: int, have: int) -> Verdict:
    """Return the verdict on a constant that is another, or not complete in `have` bytes."""
    for at, byte in enumerate(found):
        if byte != part.data[at]:
            return Verdict(None, reason, start + at, start + at + 1)
    return _too_short(have, max(have, start) + 1)


def _misfit(
    place: tuple[int, int, Reason, bytes | Callable[[bytes], int | None]], data: bytes, at: int
) -> Verdict | None:
    """Return the verdict on a place of the frame at `at` if it is wrong, or not complete."""
    start, end, reason, due = place
    found = data[at + start : at + end]
    if isinstance(due, bytes):
        if found == due:
            return None
        for offset, byte in enumerate(found):
            if byte != due[offset]:
                wrong = start if reason is Reason.COUNT_MISMATCH else start + offset
                return Verdict(None, reason, wrong, start + offset + 1)
        return _too_short(len(data) - at, max(start, len(data) - at) + 1)
    if len(found) < end - start:
        return _too_short(len(data) - at, end)
    bad = due(found)
    return None if bad is None else Verdict(None, reason, start + bad, end)


def _proven(frame: Envelope, at_id: int, size: int, data: bytes, at: int, prove: Prove) -> Verdict:
    """Judge a frame of unknown id that its checksums may prove."""
    reason = Reason.UNKNOWN_COMMAND
    if len(data) - at < size:
        return Verdict(None, reason, at_id, size, is_open=True, proven=True)
    right = all(
        data[at + size + part.at : at + size + part.at + part.size] == part.data
        for part in frame.ends
    )
    if right and prove(data, at, size, frame, ()) is None:
        return Verdict(None, reason, at_id, size, proven=True)
    return Verdict(None, reason, at_id, size)


def _wrong(data: bytes, at: int, size: int, frame: Envelope, ids: Sequence[int]) -> Checksum | None:
    """Return the first wrong checksum of a frame."""
    return frame.wrong(data[at : at + size], ids)


def _fixed(kind: type[Message]) -> tuple[int | None, int]:
    """Return the count and the size of a message, if these are always the same."""
    if kind.SHAPE.counter is not None:
        return None, 0
    return kind.SHAPE.counts[0], size_of(kind, kind.LENGTHS[0])


def _size_of_try(each: tuple[Any, Any, int]) -> int:
    return each[2]


def _counted(kind: type[Message], count: int | None) -> tuple[int, int, bytes]:
    """Return where the count of a message stands, from and to, and its bytes if it is known."""
    if kind.SHAPE.counter is None:
        return 0, 0, b""
    start, end = kind.SHAPE.counter
    if count is None:
        return start, end, b""
    due = next(place[3] for place in kind.SHAPE.places(count) if place[0] == start)
    return start, end, due if isinstance(due, bytes) else b""


def _holds(kind: type[Message]) -> Callable[[bytes], bool]:
    """Return what says whether a frame of a message's size is right, but for head and count."""
    shape, frame = kind.SHAPE, kind.FRAME
    proves = frame.prover(kind.IDS)
    if frame.judged:
        ends, last = [(part.place, part.data) for part in frame.ends], frame.address
        address = last if last in frame.judged else None
        return lambda data: (
            all(data[place] == due for place, due in ends)
            and (address is None or address.holds(address.read(data)))
            and (shape.certain or shape.holds(data))
            and (proves is None or proves(data))
        )
    if shape.certain:
        return proves or _always
    if proves is None:
        return shape.holds
    holds, right = shape.holds, proves
    return lambda data: holds(data) and right(data)


def _always(_: bytes) -> Literal[True]:
    return True


def _reach(kind: type[Message], largest: int) -> int:
    """Return how many bytes of an illegal frame may look like those of a message."""
    if not is_certain(kind) or kind.FRAME.checksums:
        return largest
    return kind.SHAPE.counter[1] if kind.SHAPE.counter else kind.FRAME.body_at


def _shown(numbers: Sequence[int]) -> str:
    return " ".join(map(str, numbers))


def _words(lengths: Sequence[int]) -> str:
    if isinstance(lengths, range):
        return describe_range(lengths)
    return " or ".join(map(str, lengths))


def _remember(known: dict[bytes, Any], key: bytes, value: Any) -> None:
    """Remember a value; if too many are known, forget the others."""
    if len(known) >= _REMEMBERED:
        known.clear()
    known[key] = value


_NOTHING = Verdict(None, Reason.BAD_HEADER, 0, 1)
