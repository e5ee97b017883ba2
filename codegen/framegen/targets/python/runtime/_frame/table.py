"""The first bytes of legal frames, by message, and why others begin none.

The bytes are tested in the order in which they come, and the first that no legal frame can have
gives the reason and the place. Single frames and streams are judged by this alone.
"""

from __future__ import annotations

from .bytes_like import as_bytes, format_hex
from .errors import DecodeError, Reason
from .pluralize import describe_range
from .protocol import (
    BODY_AT,
    COMMAND_AT,
    COMMAND_END,
    HEADER,
    LENGTH_AT,
    LENGTH_END,
    UNCOUNTED,
    read_command,
    read_length,
)
from .verdict import Verdict

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any, TypeAlias

    from .message import Message

    # The size of the frame; from where to where its count stands, and the bytes it must be (b"" at
    # 0:0 if there is no list); the class; and the entry for another message with the same head.
    Entry: TypeAlias = "tuple[int, int, int, bytes, type[Message], Entry | None]"


_new = object.__new__

ANY_SIZE = 1 << 62
"""The largest frame of a table without a bound."""

# So many heads and beginnings are remembered at once: more than any protocol's traffic has, and
# noise must not fill the memory.
_REMEMBERED = 4096

# A length that no frame has; one that no frame of its command has.
_NO_LENGTH = Verdict(None, Reason.LENGTH_MISMATCH, LENGTH_AT, LENGTH_END)
_NO_LENGTH_OF_ITS_COMMAND = Verdict(None, Reason.LENGTH_MISMATCH, LENGTH_AT, BODY_AT)


class Table(dict[bytes, "Entry"]):
    """A map from the head of a frame, up to its command, to what must follow for it to be legal.

    It learns heads as they come. Heads that do not decide alone, since a field has a range of its
    own, are not in it: `weigh` judges them. No frame is larger than `largest`.
    """

    __slots__ = ("_legal", "kinds", "largest", "messages", "reach", "verdicts", "waits")

    def __init__(self, messages: Sequence[type[Message]], largest: int) -> None:
        super().__init__()
        self.messages = messages
        self.largest = largest
        self.kinds: dict[int, list[type[Message]]] = {}
        # How many bytes of an illegal frame may look legal: up to its count, unless a field has a
        # range of its own.
        self.reach = BODY_AT
        for kind in messages:
            self.kinds.setdefault(kind.COMMAND, []).append(kind)
            count_end = kind.SHAPE.count_bytes(kind.LENGTHS[0])[1]
            self.reach = max(self.reach, largest if kind.SHAPE.narrowed else count_end)
        # What may follow the legal heads seen so far, and the verdicts on others, complete or not.
        self._legal: dict[bytes, Entry] = {}
        self.verdicts: dict[bytes, Verdict] = {}
        # The beginnings of frames seen so far, and the size at which each can be judged further.
        self.waits: dict[bytes, int] = {}

    def weigh(self, data: bytes, at: int = 0) -> Verdict:
        """Judge the frame that begins at `at`; `data` may go on behind it.

        If they may be one of several messages, it is the first that is legal; if none is, the
        refusal at the last byte is returned.
        """
        head = data[at : at + BODY_AT]
        verdict = self.verdicts.get(head)
        if verdict is not None:
            return verdict
        entry = self._legal.get(head)
        if entry is None:
            verdict = self._weigh_head(head)
            if verdict is not None:
                _remember(self.verdicts, head, verdict)
                return verdict
            entry = self._legal[head]
        furthest = _fit(data, at, entry)
        while furthest.kind is None and entry[-1] is not None:
            entry = entry[-1]
            verdict = _fit(data, at, entry)
            if verdict.kind is not None or verdict.offset > furthest.offset:
                furthest = verdict
        return furthest

    def whole(self, data: bytes, at: int) -> Entry | None:
        """Return the entry of the message at `at` if a look-up proves it, otherwise None."""
        entry = self.get(data[at : at + BODY_AT])
        if entry is not None and at + entry[0] <= len(data):
            _, count_at, count_end, count, _, _ = entry
            if data[at + count_at : at + count_end] == count:
                return entry
        return None

    def entries(self, head: bytes) -> Iterator[Entry]:
        """Yield the entries of `head`, one for each message; the first direction's comes first."""
        entry = self._legal.get(head) or self._learn(head)
        while entry is not None:
            yield entry
            entry = entry[-1]

    def may_have(self, length: int) -> bool:
        """Return whether some frame could have this length, if its command were not known."""
        return BODY_AT <= length + UNCOUNTED <= self.largest

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
        entry = self.whole(frame, 0)
        kind: type[Message] | None
        if entry is not None:
            size, kind = entry[0], entry[4]
        else:
            verdict = self.weigh(frame)
            size, kind = verdict.size, verdict.kind
        if kind is None or size != len(frame):
            return None
        message = _new(kind)
        message._frame = frame
        return message

    def error(self, frame: bytes, verdict: Verdict) -> DecodeError:
        """Return the error for `frame`, by its verdict."""
        return DecodeError(verdict.reason, verdict.offset, self._problem(frame, verdict))

    def _weigh_head(self, head: bytes) -> Verdict | None:
        """Judge `head` by itself; None if the bytes behind it decide."""
        size = len(head)
        if not head.startswith(HEADER[:size]):
            return _no_header(head)
        length = read_length(head) if size >= LENGTH_END else None
        no_length = length is not None and not self.may_have(length)
        if no_length and LENGTH_AT < COMMAND_AT:
            return _NO_LENGTH
        if size >= COMMAND_END and read_command(head) not in self.kinds:
            claim = 0 if length is None or no_length else length + UNCOUNTED
            shown, is_open = (COMMAND_END, False) if size == BODY_AT else (BODY_AT, True)
            unknown = Reason.UNKNOWN_COMMAND
            return Verdict(None, unknown, COMMAND_AT, shown, claim=claim, is_open=is_open)
        if no_length:
            return _NO_LENGTH
        if size < BODY_AT:
            return _too_short(head, 0, size + 1)
        return _NO_LENGTH_OF_ITS_COMMAND if self._learn(head) is None else None

    def _learn(self, head: bytes) -> Entry | None:
        """Return the entry of a complete head that is new, and remember it."""
        length = read_length(head)
        entry: Entry | None = None
        narrowed = False
        for kind in reversed(self.kinds.get(read_command(head), ())):
            if length in kind.LENGTHS and length + UNCOUNTED <= self.largest:
                entry = (length + UNCOUNTED, *kind.SHAPE.count_bytes(length), kind, entry)
                narrowed |= kind.SHAPE.narrowed
        if entry is not None:
            _remember(self._legal, head, entry)
            if not narrowed:
                _remember(self, head, entry)
        return entry

    def _problem(self, frame: bytes, verdict: Verdict) -> str:
        """Return what is wrong with an illegal frame, in words."""
        if verdict.kind is not None:
            name, size = verdict.kind.__name__, verdict.size
            return f"{name} with this length has {size} bytes, not {len(frame)}"
        if verdict.offset < len(HEADER):
            return f"a frame begins {format_hex(HEADER)}"
        if verdict.reason is Reason.UNKNOWN_COMMAND:
            known = ", ".join(str(number) for number in sorted(self.kinds))
            return f"the command is {read_command(frame)}, and only {known} can be here"
        if verdict.reason is Reason.LENGTH_MISMATCH:
            legal = self._lengths(frame)
            return f"the length is {read_length(frame)}, and must be {legal}"
        for entry in self.entries(frame[:BODY_AT]):
            if _fit(frame, 0, entry).offset == verdict.offset:
                return _misfit(frame, verdict, entry)
        return f"the shortest frame has {BODY_AT} bytes"

    def _lengths(self, frame: bytes) -> str:
        """Return the lengths that could stand there, in words."""
        kinds = self.kinds.get(read_command(frame), []) if len(frame) >= COMMAND_END else []
        if not kinds:
            least, most = BODY_AT - UNCOUNTED, self.largest - UNCOUNTED
            return f"at least {least}" if self.largest == ANY_SIZE else f"{least}..{most}"
        names: dict[str, list[str]] = {}
        for kind in kinds:
            names.setdefault(describe_range(kind.LENGTHS), []).append(kind.__name__)
        return " or ".join(f"{words} ({', '.join(who)})" for words, who in names.items())


def largest_of(messages: Sequence[type[Message]]) -> int:
    """Return the size of the largest frame of these messages; 0 where there are none."""
    return max((kind.LENGTHS[-1] + UNCOUNTED for kind in messages), default=0)


def _no_header(head: bytes) -> Verdict:
    """Return the verdict on bytes without a header."""
    at = next(at for at, byte in enumerate(HEADER) if head[at] != byte)
    return Verdict(None, Reason.BAD_HEADER, at, at + 1)


def _fit(data: bytes, at: int, entry: Entry) -> Verdict:
    """Judge the bytes behind a legal head at `at`, as the message of this entry."""
    size, count_at, count_end, count, kind, _ = entry
    begun = data[at + count_at : at + count_end]
    misplaced = _out_of_range(kind, data[at : at + size]) if kind.SHAPE.narrowed else None
    if misplaced is not None and (misplaced[0] < count_at or count.startswith(begun)):
        return Verdict(None, Reason.OUT_OF_RANGE, *misplaced)
    if begun == count:
        whole = at + size <= len(data)
        return (
            Verdict(kind, Reason.TRAILING_BYTES, size, size)
            if whole
            else _too_short(data, at, size)
        )
    if count.startswith(begun):
        return _too_short(data, at, count_end)
    shown = count_at + 1
    while data[at + count_at : at + shown] == count[: shown - count_at]:
        shown += 1
    return Verdict(None, Reason.COUNT_MISMATCH, count_at, shown)


def _too_short(data: bytes, at: int, size: int) -> Verdict:
    """Return the verdict on a frame that is legal so far, and judged further at `size` bytes."""
    return Verdict(None, Reason.TOO_SHORT, len(data) - at, size, is_open=True)


def _out_of_range(kind: type[Message], frame: bytes) -> tuple[int, int] | None:
    """Return from and to which byte the first number of a frame outside its range stands."""
    out_of_range = kind.SHAPE.out_of_range
    found = out_of_range(frame)
    if found is None:
        return None
    at = found[0]
    return at, next(end for end in range(at + 1, len(frame) + 1) if out_of_range(frame[:end]))


def _misfit(frame: bytes, verdict: Verdict, entry: Entry) -> str:
    """Return what keeps `frame` from being the message whose head it has, in words."""
    size, at, until, count, kind, _ = entry
    if verdict.reason is Reason.COUNT_MISMATCH:
        return (
            f"with this length the count is {format_hex(count)}, not {format_hex(frame[at:until])}"
        )
    misplaced = kind.SHAPE.out_of_range(frame[:size])
    if verdict.reason is Reason.OUT_OF_RANGE and misplaced is not None:
        return misplaced[1]
    return f"{kind.__name__} with this length has {size} bytes"


def _remember(known: dict[bytes, Any], key: bytes, value: Any) -> None:
    """Remember a value; if too many are known, forget the others."""
    if len(known) >= _REMEMBERED:
        known.clear()
    known[key] = value
