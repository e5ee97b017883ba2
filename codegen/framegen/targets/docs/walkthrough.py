"""A walk-through of stream decoding: what each byte shows, and where a header is given up.

The events are the reference's; here they are explained in words.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

from framegen.explanation.refusals import (
    BAD_HEADER,
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    TOO_SHORT,
)
from framegen.language.values import to_hex
from framegen.model.slots import Number
from framegen.model.stream import ReferenceDecoder
from framegen.pluralize import describe_range, pluralize

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Placed
    from framegen.model.stream import Event
    from framegen.model.verdict import Verdict


@dataclass(frozen=True, slots=True)
class Step:
    """Some bytes, and what they show. `ok` says whether a frame is still possible after them."""

    offset: int
    bytes: str
    text: str
    ok: bool


@dataclass(frozen=True, slots=True)
class EventView:
    """An event of the decoder: the name of a message; or none, and the reason."""

    data: bytes
    message: str
    reason: str

    @property
    def hex(self) -> str:
        """The bytes as people read them."""
        return to_hex(self.data)


@dataclass(frozen=True, slots=True)
class Walkthrough:
    """The steps and events of one stretch of the line, from its first byte to silence."""

    data: bytes
    direction: Direction
    steps: list[Step]
    events: list[EventView]

    @property
    def hex(self) -> str:
        """The bytes as people read them."""
        return to_hex(self.data)

    @property
    def way(self) -> str:
        """The sender and the receiver."""
        return f"{self.direction.sender} to {self.direction.receiver}"

    @property
    def query(self) -> str:
        """The query string that opens the decoder with these bytes."""
        return f"hex={self.data.hex()}&direction={self.direction.key}"


def walkthrough(model: Model, direction: Direction, data: bytes) -> Walkthrough:
    """Decode `data` step by step; the line stays quiet after it."""
    line = ReferenceDecoder(model, [direction])
    events = [piece for event in line.decode(data) for piece in _pieces(model, event)]
    steps = [step for event in events for step in _steps(line, event, data[event.at :])]
    views = [
        EventView(event.data, "" if event.message is None else event.message.name, event.reason)
        for event in events
    ]
    return Walkthrough(data, direction, steps, views)


def _pieces(model: Model, event: Event) -> Iterator[Event]:
    """Cut noise where headers occur in it, or begin at its end; leave all else whole."""
    header = model.frame.header
    inside = range(1, len(event.data) if event.kind == "noise" else 1)
    starts = [at for at in inside if header.startswith(event.data[at : at + len(header)])]
    for start, end in pairwise([0, *starts, len(event.data)]):
        yield replace(event, at=event.at + start, data=event.data[start:end])


def _steps(line: ReferenceDecoder, event: Event, rest: bytes) -> Iterator[Step]:
    """Yield the steps of one event slot by slot, until a frame is whole or impossible."""
    verdict = line.weigh(rest)
    if verdict.reason == BAD_HEADER:
        text = "no frame begins so: noise up to the next header"
        yield Step(event.at, to_hex(event.data), text, ok=False)
        return
    at = 0
    for text, end in _agreed(line.model, verdict, rest):
        yield Step(event.at + at, to_hex(rest[at:end]), text, ok=True)
        at = end
    if verdict.message is not None:
        size = pluralize(verdict.offset, "byte")
        yield Step(event.at, "", f"{verdict.message.name}, whole: {size} from here", ok=True)
        return
    piece, text = _refusal(line.model, verdict, rest, at)
    yield Step(event.at + at, to_hex(piece), text, ok=False)
    size = pluralize(len(event.data), "byte")
    text = f"{size} of noise: {event.reason}" if event.kind == "noise" else f"{size}: unknown frame"
    yield Step(event.at, to_hex(event.data), text, ok=False)


def _agreed(model: Model, verdict: Verdict, data: bytes) -> Iterator[tuple[str, int]]:
    """Yield what the slots show that agreed with a frame, and where each piece ends."""
    groups = [(kind, list(slots)) for kind, slots in groupby(verdict.seen, _kind)]
    if groups and groups[-1][0] == "values" and verdict.reason == TOO_SHORT:
        groups.pop()  # they end in the silence
    for number, (kind, slots) in enumerate(groups):
        last = slots[-1]
        value = last.slot.read(last.of(data)) if isinstance(last.slot, Number) else 0
        name = last.path
        match kind:
            case "constant":
                text = "a header: a frame may begin here"
            case "length":
                size = pluralize(value + model.frame.uncounted, "byte")
                text = f"{name} {value}: the frame would have {size}"
            case "id" if verdict.likely is not None:
                text = f"{name} {value}: {verdict.likely.name}, {_rule(verdict.likely)}"
            case "count":
                text = f"{name} {value}: agrees with the length"
            case _:
                is_last = number == len(groups) - 1
                text = "the rest of the values" if is_last else "values, which may be anything"
        yield text, last.end


def _kind(placed: Placed) -> str:
    """Return what is shown together: each number of the head and the count alone, else all."""
    role = placed.slot.role
    return role if role in ("constant", "length", "id", "count") else "values"


def _refusal(model: Model, verdict: Verdict, data: bytes, at: int) -> tuple[bytes, str]:
    """Return the bytes at `at` that rule out a frame, and why."""
    frame, message, rest = model.frame, verdict.likely, data[at:]
    if verdict.reason == TOO_SHORT:
        return rest, "the line goes quiet before the frame is whole"
    if verdict.reason == LENGTH_MISMATCH and frame.length.at >= at:
        length = rest[: frame.length.size]
        return length, f"{frame.length.name} {frame.length.read(length)}: no frame has it"
    if message is None:
        code = rest[: frame.id.size]
        unknown = "unknown in this direction, so its length is not trusted"
        return code, f"{frame.id.name} {frame.id.read(code)}: {unknown}"
    if verdict.reason == LENGTH_MISMATCH:
        legal = describe_range(message.lengths)
        return b"", f"the {frame.length.name} of {message.name} is {legal}"
    if verdict.reason == COUNT_MISMATCH and message.items is not None:
        counter = message.items.counter
        count = rest[: counter.size]
        number = frame.length.read_in(data)
        due = f"with a {frame.length.name} of {number} it is {message.count_at(number)}"
        return count, f"{counter.name} {counter.read(count)}: {due}"
    return b"", verdict.expected


def _rule(message: MessageLayout) -> str:
    lengths = message.lengths
    name = message.frame.length.name
    if len(lengths) == 1:
        return f"whose {name} is always {lengths[0]}"
    return f"whose {name} is {message.formula}: {describe_range(lengths)}"
