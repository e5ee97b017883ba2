"""Further random questions, repeatable by seed, beyond those that are published."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, Any, TypeVar

from framegen.conformance.language import Decode, Encode, Stream
from framegen.model.codec import encode
from framegen.model.slots import Number

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.conformance.language import Question
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

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
    small = max(model.frame.least, min(_SMALL, largest))
    most = dice.pick((largest, largest, small, model.frame.least + dice.below(_SMALL)))
    # What is certain is reported without waiting for quiet.
    last = () if dice.below(6) == 0 else (None,)
    return Stream(way, most, (*parts, *last))


def _piece(model: Model, dice: _Dice, way: Direction) -> bytes:
    """Make a frame, one with something wrong, or noise that resembles the beginning of one."""
    message = dice.pick(list(model.sent(way)))
    frame = encode(message, _values(dice, message, wild=False))
    at = dice.below(len(frame))
    # In front of the fields is where most goes wrong.
    early = dice.below(model.frame.body_at)
    stepped = bytes([(frame[early] + dice.pick((1, -1, 3))) & 0xFF])
    begun = b"".join(_part(dice, slot) for slot in model.frame.head)
    pieces = (
        frame,
        frame,
        frame[:at],
        frame[:at] + frame[at + 1 :],
        frame[:at] + dice.bytes(1) + frame[at:],
        frame[:at] + dice.bytes(1) + frame[at + 1 :],
        frame[:early] + stepped + frame[early + 1 :],
        model.frame.header[: 1 + at] + frame,
        begun + dice.bytes(dice.below(6)),
        dice.bytes(1 + dice.below(3)),
    )
    return dice.pick(pieces)


def _part(dice: _Dice, slot: Any) -> bytes:
    if not isinstance(slot, Number):
        return bytes(slot.data)
    return slot.write(slot.low + dice.below(min(16, slot.high - slot.low + 1)))


def _values(dice: _Dice, message: MessageLayout, *, wild: bool) -> dict[str, Any]:
    """Make values that a frame can carry; `wild` ones may be just outside their bounds."""
    values: dict[str, Any] = {}
    for slot in message.arguments:
        if isinstance(slot, Number):
            values[slot.name] = _number(dice, slot, wild=wild)
            continue
        most = min(slot.high, slot.low + _MANY)
        count = dice.pick((slot.low, min(most, slot.low + dice.below(_SOME)), most))
        if wild and dice.below(3) == 0:
            count = dice.pick((0, most + 1))
        items = [
            {field.name: _number(dice, field, wild=wild) for field in slot.fields}
            for _ in range(count)
        ]
        bare = [value for item in items for value in item.values()]
        values[slot.name] = items if slot.element else bare
    return values


def _number(dice: _Dice, field: Number, *, wild: bool) -> int:
    if wild and dice.below(8) == 0:
        return dice.pick((field.low - 1, field.high + 1))
    ends = (field.low, field.high)
    some = field.low + dice.below(field.high - field.low + 1)
    return dice.pick((*ends, some, some))
