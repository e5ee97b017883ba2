"""Explanation of a frame byte by byte, or of where and why bytes stop being a frame.

Content alone: `explain_text` formats it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.lookalikes import recognise
from framegen.model.slots import Number
from framegen.model.verdict import UNKNOWN_COMMAND, weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Placed
    from framegen.model.verdict import Verdict

# So many of the frames inside other bytes are told.
_MOST_WITHIN = 8


@dataclass(frozen=True, slots=True)
class Row:
    """Some bytes of a frame that belong together: a part of the frame, or a field.

    `role` is that of its slot; `value` is None for constant bytes; `text` is the value as people
    write it, `7500 mV = 7.500 V`.
    """

    offset: int
    data: bytes
    path: str
    role: str
    value: int | None
    text: str
    meaning: str

    @property
    def end(self) -> int:
        """The offset after the last byte."""
        return self.offset + len(self.data)


@dataclass(frozen=True, slots=True)
class Reading:
    """The meaning of a frame in one direction; `facts` are lines of a label and a text."""

    message: str
    direction: Direction
    summary: str
    rows: tuple[Row, ...]
    facts: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why the bytes are no frame in one direction; `rows` are the slots that agreed."""

    direction: Direction
    reason: str
    offset: int
    expected: str
    rows: tuple[Row, ...]


@dataclass(frozen=True, slots=True)
class Hint:
    """What the bytes may be instead; `frame` is the frame that the text mentions, if any."""

    text: str
    frame: bytes = b""


@dataclass(frozen=True, slots=True)
class Explanation:
    """An explanation of some bytes. Without readings, they are no frame."""

    protocol: str
    data: bytes
    readings: tuple[Reading, ...]
    refusals: tuple[Refusal, ...]
    hints: tuple[Hint, ...]


def explain(model: Model, data: bytes, directions: Sequence[Direction]) -> Explanation:
    """Explain `data` as one frame sent in any of `directions`."""
    outcomes = [_outcome(model, data, direction) for direction in directions]
    readings = tuple(outcome for outcome in outcomes if isinstance(outcome, Reading))
    refusals = [outcome for outcome in outcomes if isinstance(outcome, Refusal)]
    refusals.sort(key=_distance)
    hints = () if readings else tuple(dict.fromkeys(_hints(model, data, refusals)))
    return Explanation(model.spec.protocol.title, data, readings, tuple(refusals), hints)


def _outcome(model: Model, data: bytes, direction: Direction) -> Reading | Refusal:
    verdict = weigh_whole(model, [direction], data)
    message, rows = verdict.message, seen_rows(verdict, data)
    if message is None:
        right = tuple(row for row in rows if row.end <= verdict.offset)
        return Refusal(direction, verdict.reason, verdict.offset, verdict.expected, right)
    facts = tuple(_facts(model, message, data))
    return Reading(message.name, direction, message.message.summary, rows, facts)


def _distance(refusal: Refusal) -> tuple[bool, int]:
    """Order refusals: the direction in which the bytes came closest to a frame is first."""
    return refusal.reason == UNKNOWN_COMMAND, -len(refusal.rows)


def seen_rows(verdict: Verdict, data: bytes) -> tuple[Row, ...]:
    """Explain the slots that agreed with the beginning of a frame."""
    return tuple(_row(placed, data, verdict.likely) for placed in verdict.seen)


def _row(placed: Placed, data: bytes, message: MessageLayout | None) -> Row:
    """Explain the bytes of a slot; `message` is the one that they began, if it is known."""
    slot, piece = placed.slot, placed.of(data)
    where = (placed.at, piece, placed.path, slot.role)
    if not isinstance(slot, Number):
        return Row(*where, None, "", slot.about)
    value = slot.read(piece)
    if slot.is_field:
        return Row(*where, value, *_said(slot, value))
    meaning = slot.field.about
    if slot.role == "length" and message is not None:
        meaning = str(message.formula) if message.formula.name else f"always {message.formula}"
    elif slot.role == "id":
        meaning = "" if message is None else _named(message)
    return Row(*where, value, str(value), meaning)


def _said(field: Number, value: int) -> tuple[str, str]:
    """Describe a value: with its unit, in its larger unit, by its name."""
    text = f"{value} {field.field.unit}".rstrip()
    if field.field.scale is not None:
        text += f" = {field.field.scale.of(value)}"
    for name, named in field.field.values.items():
        if named.value == value:
            return f"{text} ({name})", named.about
    return text, field.field.about


def _named(message: MessageLayout) -> str:
    vendor_name = message.message.vendor_name
    return f"{message.name}, {vendor_name} to the vendor" if vendor_name else message.name


def _facts(model: Model, message: MessageLayout, data: bytes) -> Iterator[tuple[str, str]]:
    said = message.message
    if said.deprecated:
        yield "deprecated", said.deprecated
    kind = model.kind(message.name)
    if kind in ("command", "query"):
        yield "reply", said.reply or "none is due"
    if said.reports:
        yield "reported by", ", ".join(said.reports)
    for fact, others in ("answers", model.answers), ("reports on", model.reports_on):
        if message.name in others:
            yield fact, ", ".join(others[message.name])
    for example in said.examples:
        if example.hex == data:
            cite = "" if example.cite is None else f" ({example.cite})"
            yield "example", f"{example.title}{cite}"
    source = model.spec.sources.get(said.cite.source)
    yield "source", str(said.cite) if source is None else f"{said.cite} ({source.title})"


def _hints(model: Model, data: bytes, refusals: Sequence[Refusal]) -> Iterator[Hint]:
    """Suggest what the bytes are instead."""
    otherwise = _names(model, model.directions, data)
    if otherwise:
        yield Hint(f"sent the other way, they are {otherwise}")
        return
    found = recognise(model, data)
    if found is not None and found.lookalike.frame is not None:
        title, about = found.lookalike.title, " ".join(found.lookalike.about.split())
        yield Hint(f"this looks like a frame of {_the(title)}. {about}")
    within = list(_frames_within(model, data))
    if not within:
        yield from _command_hints(model, data, refusals)
    yield from _length_hints(model, data, refusals)
    yield from within


def _command_hints(model: Model, data: bytes, refusals: Sequence[Refusal]) -> Iterator[Hint]:
    """Say what an unknown command means elsewhere, or why it is reserved."""
    spec = model.spec
    unknown = [refusal for refusal in refusals if refusal.reason == UNKNOWN_COMMAND]
    if not unknown:
        return
    code = model.frame.id.read_in(data)
    for lookalike in spec.lookalikes.values():
        if lookalike.frame is None and code in lookalike.commands:
            yield Hint(f"in {_the(lookalike.title)}, {code} {lookalike.commands[code]}")
            return
    for reserved in spec.reserved:
        ways = [refusal.direction for refusal in unknown]
        if reserved.id == code and (reserved.direction is None or reserved.direction in ways):
            yield Hint(f"{code} is reserved: {reserved.why}")


def _the(title: str) -> str:
    return f"the {title.removeprefix('The ')}"


def _length_hints(model: Model, data: bytes, refusals: Sequence[Refusal]) -> Iterator[Hint]:
    """Try the length that so many bytes should have."""
    frame = model.frame
    length = len(data) - frame.uncounted
    if length not in range(frame.length.high + 1) or len(data) < frame.body_at:
        return
    at, size = frame.length.at, frame.length.size
    mended = data[:at] + frame.length.write(length) + data[at + size :]
    names = _names(model, [refusal.direction for refusal in refusals], mended)
    if names:
        yield Hint(
            f"{len(data)} bytes have a {frame.length.name} of {length}; with that they are {names}",
            mended,
        )


def _frames_within(model: Model, data: bytes) -> Iterator[Hint]:
    """Find whole frames among the bytes, from the first byte on."""
    found = at = 0
    while at + model.frame.body_at <= len(data):
        size = _claimed_size(model, data, at)
        piece = data[at : at + size]
        names = _names(model, model.directions, piece)
        if not names:
            at += 1
            continue
        found += 1
        if found > _MOST_WITHIN:
            yield Hint(f"more frames follow, from byte {at} on")
            return
        yield Hint(f"a frame begins at byte {at}: {names}", piece)
        at += size


def _claimed_size(model: Model, data: bytes, at: int) -> int:
    """Return the size that a frame which begins at `at` claims."""
    return model.frame.uncounted + model.frame.length.read_in(data[at:])


def _names(model: Model, directions: Sequence[Direction], data: bytes) -> str:
    """Name the messages that `data` is, at most one for each direction; empty for none."""
    return " or ".join(
        f"{message.name} ({direction})"
        for direction in directions
        if (message := weigh_whole(model, [direction], data).message) is not None
    )
