"""Random values of messages, the same for the same seed everywhere."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, Any, TypeVar

from framegen.model.slots import Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.model.layout import MessageLayout
    from framegen.model.slots import Field

    Choice = TypeVar("Choice")

# As many elements are in a list, as a rule, and at the most.
_SOME, _MANY = 4, 0x100


class Dice:
    """Random choices that are the same on every Python: `random` is all that Random guarantees."""

    def __init__(self, seed: int) -> None:
        self._random = Random(seed)  # noqa: S311 - nothing is secret

    def below(self, end: int) -> int:
        """Return a number from 0 to in front of the end."""
        return int(self._random.random() * end)

    def pick(self, choices: Sequence[Choice]) -> Choice:
        """Return one of some choices."""
        return choices[self.below(len(choices))]

    def bytes(self, size: int) -> bytes:
        """Return so many bytes."""
        return bytes(self.below(0x100) for _ in range(size))


def random_values(dice: Dice, message: MessageLayout, *, wild: bool = False) -> dict[str, Any]:
    """Make values that a frame can carry; `wild` ones may be just outside their bounds."""
    there = {slot.name for slot in message.there(dice.pick(message.counts))}
    return {
        slot.name: _value(dice, slot, wild=wild)
        if slot.name in there or slot is message.items
        else None
        for slot in message.arguments
    }


def _value(dice: Dice, slot: Field, *, wild: bool) -> Any:
    match slot:
        case Number():
            return _number(dice, slot, wild=wild)
        case Text():
            return _text(dice, dice.below(slot.size + 1 + wild)).rstrip("\0")
        case Packed():
            return [_whole(dice, slot, wild=wild) for _ in range(slot.count)]
        case Items():
            return _list(dice, slot, wild=wild)


def _list(dice: Dice, slot: Items, *, wild: bool) -> Any:
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


def _text(dice: Dice, size: int) -> str:
    return "".join(chr(dice.pick((dice.below(0x80), 0x41))) for _ in range(size))


def _number(dice: Dice, field: Number, *, wild: bool) -> float:
    if not field.is_float:
        return _whole(dice, field, wild=wild)
    some = (0.0, -0.5, float(field.low), float(field.high), 1.0 / (1 + dice.below(100)))
    return field.value(field.write(dice.pick(some)))


def _whole(dice: Dice, field: Number | Packed, *, wild: bool) -> int:
    if wild and dice.below(8) == 0:
        return dice.pick((field.low - 1, field.high + 1))
    ends = (field.low, field.high)
    some = field.low + dice.below(field.high - field.low + 1)
    return dice.pick((*ends, some, some))
