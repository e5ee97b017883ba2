"""What a line carries that speaks a protocol: frames of its messages, with values by chance."""

from random import Random
from typing import Any

from framegen.model.codec import encode
from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.model.slots import Items, Number, Packed, Text

# Longer lists tell nothing that shorter ones do not.
_MOST = 12


def traffic(model: Model, chance: Random, frames: int = 200) -> list[bytes]:
    """Return frames of all messages, in any order."""
    messages = [*model.messages.values()]
    chosen = (chance.choice(messages) for _ in range(frames))
    return [encode(message, values_for(message, chance)) for message in chosen]


def values_for(message: MessageLayout, chance: Random) -> dict[str, Any]:
    """Return values of one message that a frame can carry."""
    fewest, most = message.counts[0], message.counts[-1]
    count = chance.randint(fewest, max(fewest, min(most, fewest + _MOST)))
    values: dict[str, Any] = {}
    slots = message.there(count) if message.optional else message.arguments
    there = {slot.name for slot in slots}
    for slot in message.arguments:
        if slot.name not in there and slot in message.optional:
            values[slot.name] = None
        elif isinstance(slot, Items):
            size = slot.low if slot.is_fixed else count
            if slot.text is not None:
                values[slot.name] = _text(size, chance)
            elif slot.element is None:
                values[slot.name] = [_value(slot.fields[0], chance) for _ in range(size)]
            else:
                items = ({f.name: _value(f, chance) for f in slot.fields} for _ in range(size))
                values[slot.name] = [*items]
        elif isinstance(slot, Packed):
            values[slot.name] = [chance.randint(slot.low, slot.high) for _ in range(slot.count)]
        else:
            values[slot.name] = _value(slot, chance)
    return values


def _value(slot: Number | Text, chance: Random) -> float | str:
    if isinstance(slot, Text):
        return _text(chance.randint(0, slot.size), chance)
    if slot.is_float:
        return float(chance.randint(-1000, 1000))
    if slot.role == "address":
        # A line has a few devices.
        address: int = chance.choice(range(slot.low, min(slot.high, slot.low + 5) + 1))
        return address
    low, high = slot.low, slot.high
    near = max(low, min(0, high))
    number: int = chance.randint(*chance.choice([(low, high), (near, min(high, near + 20))]))
    return number


def _text(size: int, chance: Random) -> str:
    return "".join(chance.choice("abcdefgh 0123") for _ in range(size))
