"""Explanation of a frame byte by byte, or of where and why bytes stop being a frame.

Content alone: `text` formats it.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..protocol.places import lay_out
from ..protocol.slots import Number, Packed, Text
from .checksum import sealed
from .closest import closest
from .lookalikes import recognise
from .refusals import (
    BAD_CHECKSUM,
    TRAILING_BYTES,
    UNKNOWN_COMMAND,
    Refused,
)
from .slot_bytes import frame_length, is_in, legal_length, piece, read_in, value_of, write
from .words import in_words, listed, order_in_words

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from typing import TypeAlias

    from ..protocol.envelope import Envelope
    from ..protocol.message import Message
    from ..protocol.places import Placed
    from ..protocol.protocol import Protocol
    from ..protocol.words import Example
    from .closest import Attempt
    from .slot_bytes import Value

    # The verdict on bytes as exactly one frame, sent in a direction.
    Judge: TypeAlias = Callable[[str, bytes], "Judgement"]

# So many of the frames inside other bytes are shown.
_MOST_WITHIN = 8


@dataclass(frozen=True)
class Judgement:
    """The name of the message that bytes are; or none, with the reason and where it shows."""

    message: str | None
    reason: str = ""
    offset: int = 0


@dataclass(frozen=True)
class Row:
    """Some bytes of a frame that belong together: a part of the frame, or a field.

    `role` is that of its slot; `value` is None for constant bytes; `text` is the value as people
    write it, `7500 mV = 7.500 V`; `order` says which byte of a number comes first.
    """

    offset: int
    data: bytes
    path: str
    role: str
    value: Value | None
    text: str
    meaning: str
    order: str

    @property
    def end(self) -> int:
        """The offset after the last byte."""
        return self.offset + len(self.data)


@dataclass(frozen=True)
class Reading:
    """The meaning of a frame in one direction; `facts` are lines of a label and a text."""

    message: str
    direction: str
    summary: str
    rows: tuple[Row, ...]
    facts: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Refusal:
    """Why the bytes are no frame in one direction; `rows` are the slots that agreed."""

    direction: str
    reason: str
    offset: int
    expected: str
    rows: tuple[Row, ...]


@dataclass(frozen=True)
class Hint:
    """What the bytes may be instead; `frame` is the frame that the text mentions, if any."""

    text: str
    frame: bytes = b""


@dataclass(frozen=True)
class Explanation:
    """An explanation of some bytes. Without readings, they are no frame."""

    protocol: str
    data: bytes
    readings: tuple[Reading, ...]
    refusals: tuple[Refusal, ...]
    hints: tuple[Hint, ...]


def explain(
    protocol: Protocol, judge: Judge, data: bytes, directions: Sequence[str]
) -> Explanation:
    """Explain `data` as one frame sent in any of `directions`."""
    return _Explainer(protocol, judge, data).explain(directions)


def rows_of(data: bytes, slots: Iterable[Placed], message: Message | None) -> tuple[Row, ...]:
    """Explain the bytes of slots; `message` is the one that they began, if it is known."""
    return tuple(_row(placed, data, message) for placed in slots)


def _row(placed: Placed, data: bytes, message: Message | None) -> Row:
    slot, found = placed.slot, piece(placed, data)
    where, order = (placed.at, found, placed.path, slot.role), order_in_words(slot)
    if not isinstance(slot, (Number, Packed, Text)):
        return Row(*where, None, "", slot.about, order)
    value = value_of(slot, found)
    if not isinstance(slot, Number) or slot.is_field or slot.role == "address":
        return Row(*where, value, *in_words(slot, value), order)
    meaning = slot.about
    if slot.role == "length" and message is not None:
        meaning = message.formula if message.varies else f"always {message.formula}"
    elif slot.role == "checksum":
        meaning = f"{slot.method} of {listed(slot.of)}"
    elif slot.role == "id":
        is_last = message is not None and slot is message.envelope.id
        meaning = named(message) if message is not None and is_last else ""
    return Row(*where, value, str(value), meaning, order)


def named(message: Message) -> str:
    """Name a message, as the vendor does, too."""
    vendor_name = message.vendor_name
    return f"{message.name}, {vendor_name} to the vendor" if vendor_name else message.name


def facts(protocol: Protocol, message: Message, data: bytes) -> Iterator[tuple[str, str]]:
    """Yield what else is to be said of a message with such a frame: a label and a text each."""
    if message.deprecated:
        yield "deprecated", message.deprecated
    if message.kind in ("command", "query"):
        yield "reply", message.reply or "none is due"
    for fact, names in (
        ("reported by", message.reports),
        ("answers", message.answers),
        ("reports on", message.reports_on),
    ):
        if names:
            yield fact, ", ".join(names)
    for example in message.examples:
        if bytes.fromhex(example.hex) == data:
            yield "example", example_in_words(example)
    cite = message.cite
    source = protocol.sources.get(cite.partition(",")[0])
    yield "source", cite if source is None else f"{cite} ({source.title})"


def example_in_words(example: Example) -> str:
    """Name a documented frame, with where it is documented."""
    return f"{example.title} ({example.cite})" if example.cite else example.title


def _distance(refusal: Refusal) -> tuple[bool, int]:
    """Order refusals: the direction in which the bytes came closest to a frame is first."""
    return refusal.reason == UNKNOWN_COMMAND, -len(refusal.rows)


@dataclass(frozen=True)
class _Explainer:
    """Some bytes, and what there is to explain them by."""

    protocol: Protocol
    judge: Judge
    data: bytes

    def explain(self, directions: Sequence[str]) -> Explanation:
        readings: list[Reading] = []
        refusals: list[Refusal] = []
        for direction in directions:
            judgement = self.judge(direction, self.data)
            if judgement.message is None:
                refusals.append(self._refusal(direction, judgement))
            else:
                readings.append(self._reading(self.protocol.messages[judgement.message]))
        refusals.sort(key=_distance)
        hints = () if readings else tuple(dict.fromkeys(self._hints(refusals)))
        return Explanation(self.protocol.title, self.data, tuple(readings), tuple(refusals), hints)

    def _reading(self, message: Message) -> Reading:
        slots = self._slots(message.envelope, message, len(self.data))
        rows = rows_of(self.data, slots, message)
        said = tuple(facts(self.protocol, message, self.data))
        return Reading(message.name, message.direction, message.summary, rows, said)

    def _refusal(self, direction: str, judgement: Judgement) -> Refusal:
        reason, offset = judgement.reason, judgement.offset
        attempts = closest(self.protocol, direction, self.data, reason, offset)
        expected: dict[str, str] = {}
        for attempt in attempts:
            expected.setdefault(self._expected(direction, attempt), attempt.name)
        words = (
            [f"{name}: {due}" for due, name in expected.items()] if len(expected) > 1 else expected
        )
        first = attempts[0]
        known = first.message if len(attempts) == 1 else None
        right = rows_of(self.data, self._slots(first.frame, first.message, offset), known)
        return Refusal(direction, reason, offset, "; ".join(words), right)

    def _expected(self, direction: str, attempt: Attempt) -> str:
        """Say what would have been due for bytes to be what they were taken for."""
        refused = Refused(
            self.protocol,
            attempt.frame,
            [direction],
            self.data,
            attempt.reason,
            attempt.offset,
            attempt.message,
            self.protocol.largest([direction]),
        )
        return refused.expected()

    def _slots(self, frame: Envelope, message: Message | None, end: int) -> list[Placed]:
        """Return the slots up to an offset, in frames of a message if it is known."""
        head = frame.head
        length = None if message is None else legal_length(message, self.data)
        if message is None or length is None or (head and end < head[-1].end):
            return [placed for placed in head if placed.end <= end]
        return [placed for placed in message.lay_out(length) if placed.end <= end]

    def _hints(self, refusals: Sequence[Refusal]) -> Iterator[Hint]:
        """Suggest what the bytes are instead."""
        otherwise = self._names(self.protocol.directions, self.data)
        if otherwise:
            yield Hint(f"sent the other way, they are {otherwise}")
            return
        found = recognise(self.protocol, self.data)
        if found is not None and found.lookalike.envelope is not None:
            title, about = found.lookalike.title, " ".join(found.lookalike.about.split())
            yield Hint(f"this looks like a frame of {_the(title)}. {about}")
        within = list(self._frames_within())
        if not within:
            yield from self._command_hints(refusals)
        for frame in self._envelopes_of(refusals):
            yield from self._length_hints(frame, refusals)
            yield from self._checksum_hints(frame, refusals)
        yield from within

    def _envelopes_of(self, refusals: Sequence[Refusal]) -> list[Envelope]:
        """Return the envelopes that frames of these directions have."""
        ways = {refusal.direction for refusal in refusals}
        messages = (each for each in self.protocol.messages.values() if each.direction in ways)
        return list({each.envelope.name: each.envelope for each in messages}.values())

    def _command_hints(self, refusals: Sequence[Refusal]) -> Iterator[Hint]:
        """Say what an unknown command means elsewhere, or why it is reserved."""
        unknown = [each.direction for each in refusals if each.reason == UNKNOWN_COMMAND]
        for frame in self._envelopes_of(refusals) if unknown else ():
            part = frame.id
            if part is None or not is_in(part, self.data):
                continue
            hints = [*self._meanings(read_in(part, self.data), unknown)]
            if frame.checksums and self._is_proven(frame):
                hints.append(Hint("the checksum is right: a frame that this spec does not have"))
            if hints:
                yield from hints
                return

    def _meanings(self, number: int, directions: Sequence[str]) -> Iterator[Hint]:
        for lookalike in self.protocol.lookalikes.values():
            if lookalike.envelope is None and number in lookalike.commands:
                yield Hint(f"in {_the(lookalike.title)}, {number} {lookalike.commands[number]}")
                return
        for reserved in self.protocol.reserved:
            way = reserved.direction or directions[0]
            if reserved.id == number and way in directions:
                yield Hint(f"{number} is reserved: {reserved.why}")

    def _is_proven(self, frame: Envelope) -> bool:
        """Tell whether the bytes are as long as they say, with the right checksums."""
        if frame.length is None or frame.unsent or len(self.data) < frame.least:
            return False
        size = frame_length(frame, self.data) + frame.uncounted
        return size == len(self.data) and sealed(frame, self.data) == self.data

    def _length_hints(self, frame: Envelope, refusals: Sequence[Refusal]) -> Iterator[Hint]:
        """Try the length that so many bytes should have, also with the checksum made to fit."""
        size = len(self.data)
        length = size - frame.uncounted
        if frame.length is None or not 0 <= length <= frame.length.high:
            return
        if size < frame.body_at:
            return
        at, end = frame.length.at, frame.length.at + frame.length.size
        mended = self.data[:at] + write(frame.length, length) + self.data[end:]
        if mended == self.data:
            return
        has = f"{size} bytes have a {frame.length.name} of {length}"
        names = self._names([refusal.direction for refusal in refusals], mended)
        if names:
            yield Hint(f"{has}; with that they are {names}", mended)
            return
        for whole, names in self._sealed(frame, mended, refusals):
            yield Hint(
                f"{has}; with that and {_its(frame, mended, whole)} they would be {names}", whole
            )

    def _checksum_hints(self, frame: Envelope, refusals: Sequence[Refusal]) -> Iterator[Hint]:
        """Make the checksum fit, where that alone is wrong."""
        if any(each.reason == BAD_CHECKSUM for each in refusals):
            for whole, names in self._sealed(frame, self.data, refusals):
                yield Hint(f"with {_its(frame, self.data, whole)} they would be {names}", whole)

    def _sealed(
        self, frame: Envelope, data: bytes, refusals: Sequence[Refusal]
    ) -> Iterator[tuple[bytes, str]]:
        """Return frames with the right checksums, and which messages they are."""
        if not frame.checksums or len(data) < frame.least:
            return
        unsent = (
            each.unsent_ids for each in self.protocol.messages.values() if each.envelope is frame
        )
        for hidden in dict.fromkeys(unsent):
            whole = sealed(frame, data, hidden)
            names = self._names([refusal.direction for refusal in refusals], whole)
            if names and whole != data:
                yield whole, names

    def _frames_within(self) -> Iterator[Hint]:
        """Find whole frames among the bytes, from the first byte on."""
        directions = self.protocol.directions
        # A byte more than any frame has shows where one ends.
        enough = self.protocol.largest(directions) + 1
        found, at = 0, 0
        while at < len(self.data):
            piece = self._frame_in(self.data[at : at + enough])
            if not piece:
                at += 1
                continue
            found += 1
            if found > _MOST_WITHIN:
                yield Hint(f"more frames follow, from byte {at} on")
                return
            yield Hint(f"a frame begins at byte {at}: {self._names(directions, piece)}", piece)
            at += len(piece)

    def _frame_in(self, data: bytes) -> bytes:
        """Return the whole frame that some bytes begin with; none where there is none."""
        for direction in self.protocol.directions:
            judgement = self.judge(direction, data)
            if judgement.message is not None:
                return data
            if judgement.reason == TRAILING_BYTES:
                return data[: judgement.offset]
        return b""

    def _names(self, directions: Sequence[str], data: bytes) -> str:
        """Name the messages that `data` is, at most one for each direction; empty for none."""
        judged = [(way, self.judge(way, data).message) for way in directions]
        return " or ".join(f"{name} ({way})" for way, name in judged if name is not None)


def _the(title: str) -> str:
    return f"the {title.removeprefix('The ')}"


def _its(frame: Envelope, data: bytes, whole: bytes) -> str:
    """Name the checksums of a frame that are right only where it is sealed."""
    parts = lay_out(frame.slots, len(whole))
    wrong = [each.path for each in parts if piece(each, data) != piece(each, whole)]
    return f"the right {listed(wrong)}"
