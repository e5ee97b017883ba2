"""The line language: questions to a codec and its answers, a line each.

    decode WAY HEX                   -> message NAME HEX FIELDS...  or  refused REASON OFFSET
    encode NAME FIELDS...            -> frame HEX                   or  refused
    stream WAY LARGEST PARTS...      -> the events, a line each

WAY is the key of a direction, `controller_to_host`. FIELDS are `name=value`, in the order of the
frame without counts; a list is `targets=1:800,9:800`: commas between elements, colons between the
fields of an element. In text, `%2C` is a comma, and likewise whatever is no printable character of
ASCII, or ends a text; an empty one in a list is `%00`. A field that is absent is left out. REASON
is one of the reference's words with dashes: `count-mismatch`. PARTS are chunks in hex, in the order
in which they arrive, and `quiet` wherever the line goes quiet; frames larger than LARGEST bytes are
refused. Events are `message NAME HEX FIELDS...`, `unknown HEX`, `noise REASON HEX` in pieces of any
size, and `quiet` for each `quiet` of the question, after the events that it decides. Every answer
ends with a line `end`; `unsupported` alone says that a codec cannot do what it was asked.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

from framegen.model.codec import Unencodable, encode, values_of
from framegen.model.slots import Items, Number, Text
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Field
    from framegen.model.stream import Event

END = "end"
QUIET = "quiet"
UNSUPPORTED = "unsupported"

# Which word of a line is hex.
HEX_AT = {"message": 2, "frame": 1, "unknown": 1, "noise": 2}


@dataclass(frozen=True, slots=True)
class Decode:
    """A question: what some bytes are, as one frame."""

    verb: ClassVar = "decode"

    way: Direction
    data: bytes

    @property
    def line(self) -> str:
        """The question as it is sent."""
        return f"{self.verb} {self.way.key} {self.data.hex()}".rstrip()


@dataclass(frozen=True)
class Encode:
    """A question: which frame carries some values."""

    verb: ClassVar = "encode"

    message: MessageLayout
    values: Mapping[str, Any]

    @property
    def line(self) -> str:
        """The question as it is sent."""
        return " ".join([self.verb, self.message.name, *fields(self.message, self.values)])


@dataclass(frozen=True, slots=True)
class Stream:
    """A question: what a stream holds. None among the parts is where it goes quiet."""

    verb: ClassVar = "stream"

    way: Direction
    max_frame: int
    parts: tuple[bytes | None, ...]

    @property
    def line(self) -> str:
        """The question as it is sent."""
        parts = [QUIET if part is None else part.hex() for part in self.parts if part != b""]
        return " ".join([self.verb, self.way.key, str(self.max_frame), *parts])


Question: TypeAlias = Decode | Encode | Stream


def answer(model: Model, question: Question) -> list[str]:
    """Return what the reference answers, without the `end`."""
    match question:
        case Decode():
            return [_decoded(model, question)]
        case Encode():
            try:
                return [f"frame {encode(question.message, question.values).hex()}"]
            except Unencodable:
                return ["refused"]
        case Stream():
            return list(_streamed(model, question))


def _decoded(model: Model, question: Decode) -> str:
    verdict = weigh_whole(model, [question.way], question.data)
    if verdict.message is None:
        return f"refused {dashed(verdict.reason)} {verdict.offset}"
    return _message(verdict.message, question.data)


def _streamed(model: Model, question: Stream) -> Iterator[str]:
    """Yield the events up to each quiet; what is still held at the end is left out."""
    line = ReferenceDecoder(model, [question.way], question.max_frame)
    for event in line.follow(question.parts):
        yield QUIET if event is None else _event(event)


def _event(event: Event) -> str:
    if event.message is not None:
        return _message(event.message, event.data)
    if event.kind == "unknown":
        return f"unknown {event.data.hex()}"
    return f"noise {dashed(event.reason)} {event.data.hex()}"


def _message(message: MessageLayout, frame: bytes) -> str:
    said = fields(message, values_of(message, frame))
    return " ".join(["message", message.name, frame.hex(), *said])


def fields(message: MessageLayout, values: Mapping[str, Any]) -> list[str]:
    """Write values in the line language: `time_ms=1000`, `targets=1:800,9:800`."""
    given = [(slot, values[slot.name]) for slot in message.arguments]
    return [f"{slot.name}={_value(slot, value)}" for slot, value in given if value is not None]


def _value(slot: Field, value: Any) -> str:
    if not isinstance(value, list):
        return _word(slot, value)
    if not isinstance(slot, Items):
        return ",".join(map(str, value))
    if slot.element is None:
        return ",".join(_word(slot.fields[0], each) for each in value)
    return ",".join(
        ":".join(_word(field, item[field.name]) or "%00" for field in slot.fields) for item in value
    )


def _word(slot: Field, value: Any) -> str:
    """Write a number, or a text without anything that would end it or not be seen."""
    if isinstance(value, str):
        return _SPECIAL.sub(lambda found: f"%{ord(found[0]):02X}", value)
    if isinstance(slot, Number) and slot.is_float:
        return repr(float(value))
    return str(value)


# What is no character of a text, though it may stand for one; and how one is written.
_SPECIAL = re.compile("[^!-~]|[%,:]")
_ESCAPED = re.compile("%([0-9A-Fa-f]{2})")


def single_value(slot: Number | Text, text: str) -> float | str:
    """Read a number or a fixed text as it is written in a line. Raises ValueError."""
    if isinstance(slot, Text):
        return unescaped(text).rstrip("\0")
    return float(text) if slot.is_float else int(text)


def unescaped(text: str) -> str:
    """Read a text as it is written in a line."""
    return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), text)


def dashed(reason: str) -> str:
    """Write a reason as one word."""
    return reason.replace(" ", "-")


def joined(lines: Iterable[str]) -> list[str]:
    """Join neighbouring noise of one reason in the lines of an answer; write hex in lower case."""
    found: list[str] = []
    # The first two words of the last line.
    last: list[str] = []
    for line in lines:
        words = line.split()
        hexed = HEX_AT.get(words[0] if words else "", len(words))
        words[hexed : hexed + 1] = [word.lower() for word in words[hexed : hexed + 1]]
        if words[:1] == ["noise"] and len(words) == 3 and words[:2] == last:
            found[-1] += words[2]
        else:
            found.append(" ".join(words))
            last = words[:2]
    return found
