"""A stream decoded step by step: what can be told of each byte, and when a header is given up.

Slow and plain, for a page of a dozen bytes; the tests hold it to the library's StreamDecoder.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from framegen.language.values import to_hex
from framegen.model.codec import (
    BAD_HEADER,
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    OUT_OF_RANGE,
    TOO_SHORT,
    UNKNOWN_COMMAND,
    NotAFrame,
    decode,
    read_number,
)
from framegen.wording import counted, describe_range

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class Step:
    """Some bytes, and what they tell. `ok` is whether a frame is still possible after them."""

    offset: int
    bytes: str
    text: str
    ok: bool


@dataclass(frozen=True, slots=True)
class Event:
    """What the decoder gives: a message by name; or noise, its reason, and no name."""

    offset: int
    data: bytes
    message: str
    reason: str

    @property
    def hex(self) -> str:
        """The bytes as people read them."""
        return to_hex(self.data)


@dataclass(frozen=True, slots=True)
class Walk:
    """One stretch of the line, from its first byte to silence."""

    data: bytes
    direction: Direction
    steps: list[Step]
    events: list[Event]

    @property
    def hex(self) -> str:
        """The bytes as people read them."""
        return to_hex(self.data)

    @property
    def way(self) -> str:
        """Who sends it to whom."""
        return f"{self.direction.sender} to {self.direction.receiver}"

    @property
    def query(self) -> str:
        """What opens the decoder on these bytes."""
        return f"hex={self.data.hex()}&direction={self.direction.key}"


class _Refused(Exception):  # noqa: N818 - says what became of the header
    """The bytes looked at begin no frame."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason


def walk(model: Model, direction: Direction, data: bytes) -> Walk:
    """Decode `data`, after which the line stays quiet."""
    steps: list[Step] = []
    events: list[Event] = []
    at = 0
    while at < len(data):
        look = _Look(model, direction, data, at, steps)
        try:
            name, end = look.frame()
            events.append(Event(at, data[at:end], name, ""))
        except _Refused as refusal:
            end = _next_header(model.frame.header, data, at + 1)
            if refusal.reason != BAD_HEADER:
                text = f"{counted(end - at, 'byte')} of noise: {refusal.reason}"
                steps.append(Step(at, to_hex(data[at:end]), text, ok=False))
            events.append(Event(at, data[at:end], "", refusal.reason))
        at = end
    return Walk(data, direction, steps, events)


def _next_header(header: bytes, data: bytes, start: int) -> int:
    """Find the next place where a header stands, or may begin at the very end."""
    for at in range(start, len(data)):
        if header.startswith(data[at : at + len(header)]):
            return at
    return len(data)


@dataclass(slots=True)
class _Look:
    """One place where a frame may begin, looked at byte by byte."""

    model: Model
    direction: Direction
    data: bytes
    start: int
    steps: list[Step]
    at: int = field(init=False)

    def __post_init__(self) -> None:
        self.at = self.start

    def frame(self) -> tuple[str, int]:
        """Name the message that stands here, and its end. Raises _Refused."""
        frame = self.model.frame
        self._header(frame.header)
        if frame.length_at < frame.id_at:
            self._length()
            message = self._command()
        else:
            message = self._command()
            self._length()
        length = self._number(frame.length_at, frame.length.size)
        if length not in message.lengths:
            legal = describe_range(message.lengths)
            self._refuse(LENGTH_MISMATCH, f"the {frame.length_name} of {message.name} is {legal}")
        self._count(message, length)
        return self._rest(message, length)

    def _header(self, header: bytes) -> None:
        if not header.startswith(self.data[self.start : self.start + len(header)]):
            end = _next_header(header, self.data, self.start + 1)
            self._take(
                end - self.start, "no frame begins so: noise up to the next header", ok=False
            )
            raise _Refused(BAD_HEADER)
        self._take(len(header), "a header: a frame may begin here")

    def _length(self) -> None:
        frame = self.model.frame
        length = self._number(frame.length_at, frame.length.size, keep=True)
        longest = max(message.largest for message in self._sent().values())
        size = length + frame.uncounted
        if not frame.body_at <= size <= longest:
            text = f"{frame.length_name} {length}: no frame has it"
            self._take(frame.length.size, text, ok=False)
            raise _Refused(LENGTH_MISMATCH)
        text = f"{frame.length_name} {length}: the frame would have {size} bytes"
        self._take(frame.length.size, text)

    def _command(self) -> MessageLayout:
        frame = self.model.frame
        code = self._number(frame.id_at, frame.id.size, keep=True)
        message = self._sent().get(code)
        if message is None:
            text = (
                f"{frame.id_name} {code}: unknown in this direction, so its length is not trusted"
            )
            self._take(frame.id.size, text, ok=False)
            raise _Refused(UNKNOWN_COMMAND)
        self._take(frame.id.size, f"{frame.id_name} {code}: {message.name}, {_rule(message)}")
        return message

    def _count(self, message: MessageLayout, length: int) -> None:
        if message.repeat is None:
            return
        counter = message.repeat.counter
        before = self.start + counter.offset - self.at
        if before > 0:
            self._take(before, "values, which may be anything")
        count, due = (
            self._number(counter.offset, counter.wire.size),
            message.formula.count_at(length),
        )
        if count != due:
            name = self.model.frame.length_name
            text = f"{counter.name} {count}: with a {name} of {length} it is {due}"
            self._take(counter.wire.size, text, ok=False)
            raise _Refused(COUNT_MISMATCH)
        self._take(counter.wire.size, f"{counter.name} {count}: agrees with the length")

    def _rest(self, message: MessageLayout, length: int) -> tuple[str, int]:
        end = self.start + length + self.model.frame.uncounted
        if end > self.at:
            self._take(end - self.at, "the rest of the values")
        try:
            decode(self.model, self.direction, self.data[self.start : end])
        except NotAFrame as error:
            self._refuse(OUT_OF_RANGE, error.expected)
        whole = f"{message.name}, whole: {counted(end - self.start, 'byte')} from here"
        self.steps.append(Step(self.start, "", whole, ok=True))
        return message.name, end

    def _sent(self) -> Mapping[int, MessageLayout]:
        return self.model.sent(self.direction)

    def _number(self, offset: int, size: int, *, keep: bool = False) -> int:
        """Read the number at `offset` of the frame; with `keep`, only if it has arrived."""
        if keep and self.start + offset + size > len(self.data):
            self._take(size, "", ok=True)
        return read_number(self.model, self.data, self.start + offset, size)

    def _take(self, size: int, text: str, *, ok: bool = True) -> None:
        """Tell what the next bytes say, or that they never come."""
        piece = self.data[self.at : self.at + size]
        if len(piece) < size:
            self._refuse(TOO_SHORT, "the line goes quiet before the frame is whole", piece)
        self.steps.append(Step(self.at, to_hex(piece), text, ok))
        self.at += size

    def _refuse(self, reason: str, text: str, piece: bytes = b"") -> None:
        self.steps.append(Step(self.at, to_hex(piece), text, ok=False))
        raise _Refused(reason)


def _rule(message: MessageLayout) -> str:
    lengths = message.lengths
    name = message.frame.length_name
    if len(lengths) == 1:
        return f"whose {name} is always {lengths[0]}"
    return f"whose {name} is {message.formula}: {describe_range(lengths)}"
