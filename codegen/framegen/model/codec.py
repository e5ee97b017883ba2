"""The reference codec: encodes and decodes single frames slot by slot, slow and plain.

It executes the examples of a spec, explains frames and writes the test vectors. The generated
libraries are tested against it, and share no code with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.model.slots import Body, Constant, Items, Number
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Placed
    from framegen.model.verdict import Verdict


@dataclass(frozen=True, slots=True)
class Decoded:
    """A decoded frame: its layout and the values of its fields, without the count."""

    layout: MessageLayout
    values: dict[str, Any]


class NotAFrame(ValueError):  # noqa: N818 - says what the bytes are
    """Bytes that are no frame: the reason, the offset where it shows, and what was expected."""

    def __init__(self, verdict: Verdict) -> None:
        super().__init__(verdict.refusal)
        self.reason = verdict.reason
        self.offset = verdict.offset
        self.expected = verdict.expected


class Unencodable(ValueError):  # noqa: N818 - says what the values are
    """Values that no frame can carry."""


def decode(model: Model, direction: Direction | None, data: bytes) -> Decoded:
    """Decode exactly one frame, of any direction if none is given. Raises NotAFrame."""
    directions = model.directions if direction is None else [direction]
    verdict = weigh_whole(model, directions, data)
    if verdict.message is None:
        raise NotAFrame(verdict)
    return Decoded(verdict.message, values_of(verdict.message, data))


def values_of(message: MessageLayout, frame: bytes) -> dict[str, Any]:
    """Return the values of a legal frame, by field."""
    count = message.count_of(frame)
    # In the order of the frame, which is that of the fields.
    numbers = (
        placed.slot.read(placed.of(frame))
        for placed in message.lay_out(count)
        if isinstance(placed.slot, Number) and placed.slot.is_field
    )
    values: dict[str, Any] = {}
    for slot in message.fields:
        if isinstance(slot, Number):
            values[slot.name] = next(numbers)
        elif slot.element is None:
            values[slot.name] = [next(numbers) for _ in range(count)]
        else:
            values[slot.name] = [
                {field.name: next(numbers) for field in slot.fields} for _ in range(count)
            ]
    return {argument.name: values[argument.name] for argument in message.arguments}


def encode(message: MessageLayout, values: Mapping[str, Any]) -> bytes:
    """Encode the frame that carries `values`, by field. Raises Unencodable."""
    count, numbers = _numbers(message, values)
    frame = bytearray(message.size_at(count))
    for placed in message.lay_out(count):
        frame[placed.at : placed.end] = _written(message, placed, count, numbers)
    return bytes(frame)


def _written(
    message: MessageLayout, placed: Placed, count: int, numbers: Mapping[str, object]
) -> bytes:
    slot = placed.slot
    match slot:
        case Constant():
            return slot.data
        case Number(role="length"):
            return slot.write(message.formula.at(count))
        case Number(role="id"):
            return slot.write(message.id)
        case Number(role="count"):
            return slot.write(_checked(slot, slot.name, count))
        case Number():
            return slot.write(_checked(slot, placed.path, numbers[placed.path]))
        case Body():
            raise AssertionError("a message has fields where its envelope has the body")


def _numbers(message: MessageLayout, values: Mapping[str, Any]) -> tuple[int, dict[str, object]]:
    """Return the given numbers by path (`targets[0].position`), and the number of elements."""
    expected = {argument.name for argument in message.arguments}
    for name in sorted(values.keys() ^ expected):
        raise Unencodable(
            f"`{name}` is missing"
            if name in expected
            else f"{message.name} has no field `{name}` to be given"
        )
    count = 0
    numbers: dict[str, object] = {}
    for slot in message.arguments:
        if isinstance(slot, Number):
            numbers[slot.name] = values[slot.name]
            continue
        items = values[slot.name]
        if not isinstance(items, list):
            raise Unencodable(f"{slot.name} must be a list")
        count = len(items)
        if count not in message.counts:
            raise Unencodable(f"{slot.name}: {count} items is outside {slot.low}..{slot.high}")
        for index, item in enumerate(items):
            numbers |= _element(slot, index, item)
    return count, numbers


def _element(items: Items, index: int, item: Any) -> dict[str, object]:
    if items.element is None:
        return {f"{items.name}[{index}]": item}
    names = [field.name for field in items.fields]
    if not isinstance(item, dict) or set(item) != set(names):
        raise Unencodable(f"{items.name}[{index}] must have the keys {', '.join(names)}")
    return {items.path(index, field): item[field.name] for field in items.fields}


def _checked(number: Number, path: str, value: object) -> int:
    if not isinstance(value, int) or isinstance(value, bool):
        raise Unencodable(f"{path}: {value!r} is not a whole number")
    if not number.low <= value <= number.high:
        raise Unencodable(f"{path}: {value} is outside {number.low}..{number.high}")
    return value
