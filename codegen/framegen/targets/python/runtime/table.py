"""Which first bytes begin a legal frame of which message, and why others do not."""

from __future__ import annotations

from .errors import DecodeError, Reason
from .octets import octets, spaced
from .protocol import BODY_AT, COMMAND_AT, HEADER, LENGTH_AT, UNCOUNTED, read_command, read_length
from .wording import describe_range

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import TypeAlias

    from .message import Message

    # The size of the frame; from where to where its count stands, and the bytes it must be; the
    # class. Without a list, the count is b"" at 0:0.
    Entry: TypeAlias = "tuple[int, int, int, bytes, type[Message]]"


_new = object.__new__


class Table(dict[bytes, "Entry | None"]):
    """Maps the head of a frame, up to its command, to what must follow for it to be legal.

    It fills itself as heads are looked up. A head that begins no frame of these messages gives
    None, and is not kept: noise must not fill the memory. So does one that does not decide alone,
    because two directions share it or a field has a range of its own.
    """

    __slots__ = ("_legal", "kinds", "largest", "waits")

    def __init__(self, kinds: Iterable[type[Message]]) -> None:
        super().__init__()
        self.kinds: dict[int, list[type[Message]]] = {}
        for kind in kinds:
            self.kinds.setdefault(kind.COMMAND, []).append(kind)
        # The beginnings of frames that were seen, and the size at which more can be told of each.
        self.waits: dict[bytes, int] = {}
        # What may follow each legal head that was seen; of these, there are not many.
        self._legal: dict[bytes, tuple[Entry, ...]] = {}
        self.largest = max((kind.LENGTHS[-1] + UNCOUNTED for kind in kinds), default=0)

    def __missing__(self, head: bytes) -> Entry | None:
        entries = self.entries(head)
        if len(entries) != 1 or entries[0][-1].SHAPE.narrowed:
            return None
        (self[head],) = entries
        return entries[0]

    def entries(self, head: bytes) -> tuple[Entry, ...]:
        """What may follow `head`; where two directions share it, the first of them comes first."""
        found = self._legal.get(head)
        if found is None:
            if len(head) < BODY_AT or not head.startswith(HEADER):
                return ()
            length = read_length(head)
            found = tuple(
                (length + UNCOUNTED, *kind.SHAPE.count_bytes(length), kind)
                for kind in self.kinds.get(read_command(head), ())
                if length in kind.LENGTHS
            )
            if found:
                self._legal[head] = found
        return found

    def may_have(self, length: int) -> bool:
        """Whether some frame could have this length, if its command were not known."""
        return BODY_AT <= length + UNCOUNTED <= self.largest

    def read(self, frame: bytes | bytearray | memoryview) -> Message:
        """The message that `frame` is, whole and with nothing after it. Raises DecodeError."""
        if type(frame) is not bytes:
            frame = octets(frame)
        # What is known is found sooner by `get`, and what is not is learnt by the index.
        entry = self.get(frame[:BODY_AT]) or self[frame[:BODY_AT]]
        if entry is not None:
            size, at, until, count, kind = entry
            if len(frame) == size and (not until or frame[at:until] == count):
                message = _new(kind)
                message._frame = frame
                return message
        message = _new(self._looked_at(frame))
        message._frame = frame
        return message

    def _looked_at(self, frame: bytes) -> type[Message]:
        """The message that `frame` is, though not at first sight; or else why it is none."""
        errors: list[DecodeError] = []
        for entry in self.entries(frame[:BODY_AT]):
            error = _misfit(frame, *entry)
            if error is None:
                return entry[-1]
            errors.append(error)
        # Of several messages, the one that fits furthest tells most.
        raise max(errors, key=lambda error: error.offset) if errors else self._headless(frame)

    def _headless(self, frame: bytes) -> DecodeError:
        """Why no message has the head of `frame`."""
        expected = f"a frame begins {spaced(HEADER)}"
        for offset, byte in enumerate(HEADER[: len(frame)]):
            if frame[offset] != byte:
                return DecodeError(Reason.BAD_HEADER, offset, expected)
        if len(frame) < len(HEADER):
            return DecodeError(Reason.TOO_SHORT, len(frame), expected)
        if len(frame) < BODY_AT:
            problem = f"the shortest frame has {BODY_AT} bytes"
            return DecodeError(Reason.TOO_SHORT, len(frame), problem)
        command, length = read_command(frame), read_length(frame)
        kinds = self.kinds.get(command)
        if kinds is None:
            known = ", ".join(str(number) for number in sorted(self.kinds))
            problem = f"the command is {command}, and only {known} can be here"
            return DecodeError(Reason.UNKNOWN_COMMAND, COMMAND_AT, problem)
        names: dict[str, list[str]] = {}
        for kind in kinds:
            names.setdefault(describe_range(kind.LENGTHS), []).append(kind.__name__)
        legal = " or ".join(f"{words} ({', '.join(who)})" for words, who in names.items())
        problem = f"the length is {length}, and must be {legal}"
        return DecodeError(Reason.LENGTH_MISMATCH, LENGTH_AT, problem)


def _misfit(
    frame: bytes, size: int, at: int, until: int, count: bytes, kind: type[Message]
) -> DecodeError | None:
    """What keeps `frame` from being the message whose head it has."""
    if len(frame) < size:
        problem = f"{kind.__name__} with this length has {size} bytes"
        return DecodeError(Reason.TOO_SHORT, len(frame), problem)
    if len(frame) > size:
        problem = f"{kind.__name__} with this length has {size} bytes, not {len(frame)}"
        return DecodeError(Reason.TRAILING_BYTES, size, problem)
    if frame[at:until] != count:
        problem = f"with this length the count is {spaced(count)}, not {spaced(frame[at:until])}"
        return DecodeError(Reason.COUNT_MISMATCH, at, problem)
    misplaced = kind.SHAPE.out_of_range(frame)
    if misplaced is not None:
        offset, problem = misplaced
        return DecodeError(Reason.OUT_OF_RANGE, offset, problem)
    return None
