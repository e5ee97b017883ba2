"""A walk-through of stream decoding: what each byte shows, and where a header is given up.

The events are the reference's; here they are explained in words.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

from framewire.explain.refusals import (
    BAD_CHECKSUM,
    BAD_HEADER,
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    TOO_SHORT,
    UNKNOWN_COMMAND,
)
from framewire.frame.pluralize import describe_range, pluralize

from framegen.language.values import to_hex
from framegen.model.slots import Number
from framegen.model.stream import ReferenceDecoder
from framegen.targets.docs.checksum_steps import worked_out

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
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
    """An event of the decoder: the name of a message; or none, and the reason.

    `certain` is a frame of unknown id that a checksum proves.
    """

    data: bytes
    message: str
    reason: str
    certain: bool

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
        EventView(
            event.data,
            "" if event.message is None else event.message.name,
            event.reason,
            event.kind == "unknown" and line.weigh(event.data).proven,
        )
        for event in events
    ]
    return Walkthrough(data, direction, steps, views)


def _pieces(model: Model, event: Event) -> Iterator[Event]:
    """Cut noise where headers occur in it, or begin at its end; leave all else whole."""
    headers = [frame.header for frame in model.envelopes.values() if frame.header]
    inside = range(1, len(event.data) if event.kind == "noise" else 1)
    starts = [
        at
        for at in inside
        if any(header.startswith(event.data[at : at + len(header)]) for header in headers)
    ]
    for start, end in pairwise([0, *starts, len(event.data)]):
        yield replace(event, at=event.at + start, data=event.data[start:end])


def _steps(line: ReferenceDecoder, event: Event, rest: bytes) -> Iterator[Step]:
    """Yield the steps of one event slot by slot, until a frame is whole or impossible."""
    verdict = line.weigh(rest)
    if verdict.reason == BAD_HEADER:
        text = "no frame begins so: noise up to the next header"
        yield Step(event.at, to_hex(event.data), text, ok=False)
        return
    look = _Look(line.model.envelopes[verdict.frame], verdict, rest)
    at = 0
    for text, end in look.agreed():
        yield Step(event.at + at, to_hex(rest[at:end]), text, ok=True)
        at = end
    if verdict.message is not None:
        size = pluralize(verdict.offset, "byte")
        yield Step(event.at, "", f"{verdict.message.name}, whole: {size} from here", ok=True)
        return
    size = pluralize(len(event.data), "byte")
    if verdict.proven:
        for text, start, end in look.proof():
            yield Step(event.at + start, to_hex(rest[start:end]), text, ok=True)
        yield Step(event.at, to_hex(event.data), f"{size}: unknown frame, and certain", ok=True)
        return
    piece, text = look.refusal(at)
    yield Step(event.at + at, to_hex(piece), text, ok=False)
    text = f"{size} of noise: {event.reason}" if event.kind == "noise" else f"{size}: unknown frame"
    yield Step(event.at, to_hex(event.data), text, ok=False)


# What is shown by itself; all else are values, shown together.
_ALONE = (
    "constant",
    "reserved",
    "length",
    "id",
    "address",
    "counter",
    "count",
    "size",
    "checksum",
)


def _kind(placed: Placed) -> str:
    role = placed.slot.role
    return role if role in _ALONE else "values"


@dataclass(frozen=True)
class _Look:
    """What a verdict on some bytes shows, in words."""

    frame: Envelope
    verdict: Verdict
    data: bytes

    def agreed(self) -> Iterator[tuple[str, int]]:
        """Yield what the slots show that agreed with a frame, and where each piece ends."""
        verdict = self.verdict
        # A checksum is looked at last, when all of the frame has been seen.
        seen = (
            placed
            for placed in verdict.seen
            if verdict.reason != BAD_CHECKSUM or placed.at < verdict.offset
        )
        groups = [(kind, list(slots)) for kind, slots in groupby(seen, _kind)]
        if groups and groups[-1][0] == "values" and verdict.reason == TOO_SHORT:
            groups.pop()  # they end in the silence
        for number, (kind, slots) in enumerate(groups):
            if kind in ("values", "constant", "reserved"):
                is_last = number == len(groups) - 1
                yield self._together(kind, slots, is_last=is_last), slots[-1].end
                continue
            for placed in slots:
                yield self._number(placed), placed.end

    def _together(self, kind: str, slots: list[Placed], *, is_last: bool) -> str:
        if kind == "values":
            free = not any(isinstance(each.slot, Number) and each.slot.narrowed for each in slots)
            anything = "values, which may be anything"
            if self.frame.proven or not free:
                anything = "values"
            return "the rest of the values" if is_last else anything
        if kind == "reserved":
            return "reserved: read as anything"
        if slots[0].at == 0:
            return "a header: a frame may begin here"
        return f"{slots[-1].path}, which is always the same"

    def _number(self, placed: Placed) -> str:
        slot, name = placed.slot, placed.path
        if not isinstance(slot, Number):
            return name
        value, likely = slot.read(placed.of(self.data)), self.verdict.likely
        shown = ""
        if slot.role == "length":
            size = pluralize(value + self.frame.uncounted, "byte")
            shown = f"the frame would have {size}"
        elif slot.role == "id" and likely is not None and slot is self.frame.id_part:
            shown = f"{likely.name}, {_rule(likely)}"
        elif slot.counts:
            shown = self._counted(slot, value)
        elif slot.role == "address":
            named = slot.field.values.items()
            shown = next((key for key, each in named if each.value == value), "")
        elif slot.role == "checksum":
            found = to_hex(placed.of(self.data))
            return f"{found}: {self._worked_out(slot)}" if self._is_whole else f"{name} {found}"
        return f"{name} {value}: {shown}" if shown else f"{name} {value}"

    @property
    def _is_whole(self) -> bool:
        """Whether a whole frame has been seen, and what its checksums cover is known."""
        verdict = self.verdict
        if verdict.message is not None or verdict.proven:
            return True
        return verdict.reason == BAD_CHECKSUM and verdict.likely is not None

    def _counted(self, slot: Number, value: int) -> str:
        if self.frame.length_part is not None:
            return f"agrees with the {self.frame.length.name}"
        items = None if self.verdict.likely is None else self.verdict.likely.items
        count = None if items is None else items.count_at(value) if slot.role == "size" else value
        return "" if count is None else f"{pluralize(count, 'item')} of the list"

    def _worked_out(self, slot: Number) -> str:
        likely = self.verdict.likely
        covered = self.frame.covered(slot, {}) if likely is None else likely.covered(slot)
        # Behind the frame there may be more.
        return worked_out(slot.method, slot.size, covered.of(self.data[: self._end()]))

    def _end(self) -> int:
        """Return where the frame ends that the bytes begin, all of which has been seen."""
        return self.verdict.claim or self.verdict.seen[-1].end

    def proof(self) -> Iterator[tuple[str, int, int]]:
        """Yield what proves a frame of unknown id, and from where to where it stands."""
        head = len(self.verdict.seen)
        for placed in self.frame.lay_out(self.verdict.claim):
            slot = placed.slot
            is_new = placed.at >= self.frame.body_at or placed in self.frame.placed_head[head:]
            if is_new and isinstance(slot, Number):
                text = self._number(placed)
                is_it = placed.at == self.verdict.offset
                unknown = f"{text}: unknown in this direction" if is_it else text
                yield unknown, placed.at, placed.end

    def refusal(self, at: int) -> tuple[bytes, str]:
        """Return the bytes at `at` that rule out a frame, and why."""
        verdict, rest = self.verdict, self.data[at:]
        said = {
            TOO_SHORT: lambda: (rest, "the line goes quiet before the frame is whole"),
            LENGTH_MISMATCH: lambda: self._length(at),
            UNKNOWN_COMMAND: lambda: self._unknown(rest),
            COUNT_MISMATCH: lambda: self._count(rest),
            BAD_CHECKSUM: self._checksum,
        }.get(verdict.reason)
        return (b"", verdict.expected) if said is None else said()

    def _length(self, at: int) -> tuple[bytes, str]:
        length, message = self.frame.length, self.verdict.likely
        if length.at >= at:
            found = self.data[at : at + length.size]
            return found, f"{length.name} {length.read(found)}: no frame has it"
        if message is None:
            return b"", self.verdict.expected
        return b"", f"the {length.name} of {message.name} is {describe_range(message.lengths)}"

    def _unknown(self, rest: bytes) -> tuple[bytes, str]:
        part = next(part for part in self.frame.ids if part.at == self.verdict.offset)
        code = rest[: part.size]
        trust = "so its length is not trusted"
        if self.frame.proves_unknown:
            trust = "and the checksum does not prove it"
        elif self.frame.length_part is None:
            trust = "so nothing says where it would end"
        return code, f"{part.name} {part.read(code)}: unknown in this direction, {trust}"

    def _checksum(self) -> tuple[bytes, str]:
        (slot,) = (part for part in self.frame.checksums if self._stands_at(part))
        found = self.data[self.verdict.offset : self.verdict.offset + slot.size]
        return found, f"{to_hex(found)} is not it: {self._worked_out(slot)}"

    def _stands_at(self, part: Number) -> bool:
        at = part.at if part.at >= 0 else self._end() + part.at
        return at == self.verdict.offset

    def _count(self, rest: bytes) -> tuple[bytes, str]:
        message, length = self.verdict.likely, self.frame.length_part
        if message is None or message.items is None or length is None:
            return b"", self.verdict.expected
        placed = (each for each in message.lay_out(message.counts[0]) if each.slot.role in _COUNTS)
        counter = next(each.slot for each in placed if each.at == self.verdict.offset)
        if not isinstance(counter, Number):
            return b"", self.verdict.expected
        number = length.read_in(self.data)
        due = message.items.counted(counter, message.count_at(number))
        count = rest[: counter.size]
        said = f"with a {length.name} of {number} it is {due}"
        return count, f"{counter.name} {counter.read(count)}: {said}"


_COUNTS = ("count", "size")


def _rule(message: MessageLayout) -> str:
    lengths, length = message.lengths, message.frame.length_part
    name = "size" if length is None else length.name
    if len(lengths) == 1:
        return f"whose {name} is always {lengths[0]}"
    if message.items is None:
        return f"whose {name} is {describe_range(lengths)}"
    return f"whose {name} is {message.formula}: {describe_range(lengths)}"
