"""Further random questions, repeatable by seed, beyond those that are published."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, Any, TypeVar

from framegen.conformance.language import Decode, Encode, Stream
from framegen.model.codec import encode
from framegen.model.slots import Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.conformance.language import Question
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Field

    Choice = TypeVar("Choice")

# As many elements are in a list, as a rule, and at the most; and as many pieces on a line.
_SOME, _MANY, _PIECES = 4, 0x100, 7
# What many a buffer holds.
_SMALL = 64


def further(model: Model, seed: int) -> Iterator[tuple[str, Question]]:
    """Yield questions without end, each with a title; the same for the same seed everywhere."""
    dice = _Dice(seed)
    number = 0
    while True:
        number += 1
        kind = dice.pick(("decode", "encode", "stream", "stream"))
        way = dice.pick(model.directions)
        if kind == "encode":
            message = dice.pick(list(model.sent(way)))
            question: Question = Encode(message, _values(dice, message, wild=dice.below(3) == 0))
        elif kind == "decode":
            question = Decode(way, _piece(model, dice, way))
        else:
            question = _stream(model, dice, way)
        yield f"seed {seed}, question {number}", question


class _Dice:
    """Random choices that are the same on every Python: `random` is all that Random guarantees."""

    def __init__(self, seed: int) -> None:
        self._random = Random(seed)  # noqa: S311 - nothing is secret

    def below(self, end: int) -> int:
        return int(self._random.random() * end)

    def pick(self, choices: Sequence[Choice]) -> Choice:
        return choices[self.below(len(choices))]

    def bytes(self, size: int) -> bytes:
        return bytes(self.below(0x100) for _ in range(size))


def _stream(model: Model, dice: _Dice, way: Direction) -> Stream:
    largest = model.largest([way])
    line = b"".join(_piece(model, dice, way) for _ in range(1 + dice.below(_PIECES)))
    parts: list[bytes | None] = []
    while line:
        size = 1 + dice.below(dice.pick((1, 3, 16, len(line))))
        parts.append(line[:size])
        line = line[size:]
        if dice.below(8) == 0:
            parts.append(None)
    least = min(each.frame.least for each in model.candidates([way]))
    small = max(least, min(_SMALL, largest))
    most = dice.pick((largest, largest, small, least + dice.below(_SMALL)))
    # What is certain is reported without waiting for quiet.
    last = () if dice.below(6) == 0 else (None,)
    return Stream(way, most, (*parts, *last))


def _piece(model: Model, dice: _Dice, way: Direction) -> bytes:
    """Make a frame, one with something wrong, or noise that resembles the beginning of one."""
    message = dice.pick(list(model.sent(way)))
    envelope = message.frame
    frame = encode(message, _values(dice, message, wild=False))
    at = dice.below(len(frame))
    # In front of the fields is where most goes wrong.
    early = dice.below(envelope.body_at)
    stepped = bytes([(frame[early] + dice.pick((1, -1, 3))) & 0xFF])
    begun = b"".join(_part(dice, slot) for slot in envelope.head)
    changed = frame[:at] + dice.bytes(1) + frame[at + 1 :]
    pieces = (
        frame,
        frame,
        frame[:at],
        frame[:at] + frame[at + 1 :],
        frame[:at] + dice.bytes(1) + frame[at:],
        changed,
        frame[:early] + stepped + frame[early + 1 :],
        envelope.header[: 1 + at] + frame,
        begun + dice.bytes(dice.below(6)),
        dice.bytes(1 + dice.below(3)),
        # With a right checksum, a change is only found by what is looked at besides.
        *([message.sealed(changed)] * 2 if envelope.proven else ()),
    )
    piece: bytes = dice.pick(pieces)
    return piece


def _part(dice: _Dice, slot: Any) -> bytes:
    if not isinstance(slot, Number):
        return bytes(slot.data)
    return slot.write(slot.low + dice.below(min(16, slot.high - slot.low + 1)))


def _values(dice: _Dice, message: MessageLayout, *, wild: bool) -> dict[str, Any]:
    """Make values that a frame can carry; `wild` ones may be just outside their bounds."""
    there = {slot.name for slot in message.there(dice.pick(message.counts))}
    return {
        slot.name: _value(dice, slot, wild=wild)
        if slot.name in there or slot is message.items
        else None
        for slot in message.arguments
    }


def _value(dice: _Dice, slot: Field, *, wild: bool) -> Any:
    match slot:
        case Number():
            return _number(dice, slot, wild=wild)
        case Text():
            return _text(dice, dice.below(slot.size + 1 + wild)).rstrip("\0")
        case Packed():
            return [_whole(dice, slot, wild=wild) for _ in range(slot.count)]
        case Items():
            return _list(dice, slot, wild=wild)


def _list(dice: _Dice, slot: Items, *, wild: bool) -> Any:
    most = min(slot.high, slot.low + _MANY)
    count = dice.pick((slot.low, min(most, slot.low + dice.below(_SOME)), most))
    if wild and dice.below(3) == 0:
        count = dice.pick((0, most + 1))
    if slot.text is not None:
        return _text(dice, count)
    items = [
        {field.name: _value(dice, field, wild=wild) for field in slot.fields} for _ in range(count)
    ]
    bare = [value for item in items for value in item.values()]
    return items if slot.element else bare


def _text(dice: _Dice, size: int) -> str:
    return "".join(chr(dice.pick((dice.below(0x80), 0x41))) for _ in range(size))


def _number(dice: _Dice, field: Number, *, wild: bool) -> float:
    if not field.is_float:
        return _whole(dice, field, wild=wild)
    some = (0.0, -0.5, float(field.low), float(field.high), 1.0 / (1 + dice.below(100)))
    return field.value(field.write(dice.pick(some)))


def _whole(dice: _Dice, field: Number | Packed, *, wild: bool) -> int:
    if wild and dice.below(8) == 0:
        return dice.pick((field.low - 1, field.high + 1))
    ends = (field.low, field.high)
    some = field.low + dice.below(field.high - field.low + 1)
    return dice.pick((*ends, some, some))
