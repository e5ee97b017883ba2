"""The reference codec: encodes and decodes single frames slot by slot, slow and plain.

It executes the examples of a spec, explains frames and writes the test vectors. The generated
libraries are tested against it, and share no code with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.model.slots import Body, Constant, Items, Number, Packed, Text
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

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
    """Decode exactly one frame, of any direction if none is given, the client's before others.

    Raises NotAFrame.
    """
    directions = model.directions if direction is None else [direction]
    verdict = weigh_whole(model, directions, data)
    if verdict.message is None:
        raise NotAFrame(verdict)
    return Decoded(verdict.message, values_of(verdict.message, data))


def values_of(message: MessageLayout, frame: bytes) -> dict[str, Any]:
    """Return the values of a legal frame, by argument; None for a field that is absent."""
    count = message.count_of(frame)
    # A part of the frame may be called like a field.
    placed = {each.path: each for each in message.lay_out(count) if _is_given(each.slot)}

    def number(path: str) -> float | str | None:
        there = placed.get(path)
        if there is None or not isinstance(there.slot, Number | Text):
            return None
        return there.slot.value(there.of(frame))

    values: dict[str, Any] = {}
    for slot in message.arguments:
        match slot:
            case Number() | Text():
                values[slot.name] = number(slot.name)
            case Packed():
                values[slot.name] = slot.values(placed[slot.name].of(frame))
            case Items():
                elements = range(slot.low if slot.is_fixed else count)
                values[slot.name] = _items(slot, elements, number)
    return values


def _is_given(slot: object) -> bool:
    return slot.given if isinstance(slot, Number) else isinstance(slot, Text | Packed)


def _items(items: Items, elements: range, number: Callable[[str], float | str | None]) -> Any:
    """Return the value of a list, whose numbers are found by path."""
    if items.element is not None:
        return [
            {field.name: number(items.path(index, field)) for field in items.fields}
            for index in elements
        ]
    (field,) = items.fields
    numbers = [number(items.path(index, field)) for index in elements]
    if items.text is None:
        return numbers
    return bytes(int(each or 0) for each in numbers).decode(items.text)


def encode(message: MessageLayout, values: Mapping[str, Any], like: bytes | None = None) -> bytes:
    """Encode the frame that carries `values`, by argument. Raises Unencodable.

    A running number may be left out, and an optional field be None: it is absent. Reserved bytes
    are those of a frame of the same size, if it is given.
    """
    count, numbers = _numbers(message, values)
    frame = bytearray(message.size_at(count))
    for placed in message.lay_out(count):
        if placed.slot.role == "reserved" and like is not None:
            frame[placed.at : placed.end] = placed.of(like)
        elif placed.slot.role != "checksum":
            frame[placed.at : placed.end] = _written(message, placed, count, numbers)
    return message.sealed(bytes(frame))


def _written(
    message: MessageLayout, placed: Placed, count: int, numbers: Mapping[str, Any]
) -> bytes:
    slot = placed.slot
    match slot:
        case Constant():
            return slot.data
        case Packed():
            return slot.write(numbers[placed.path])
        case Text():
            return _text(slot, placed.path, numbers[placed.path])
        case Number():
            return slot.write(_number(message, slot, placed.path, count, numbers))
        case Body():
            raise AssertionError("a message has fields where its envelope has the body")


def _number(
    message: MessageLayout, slot: Number, path: str, count: int, numbers: Mapping[str, Any]
) -> float:
    """Return the value of a number, which follows from the rest of the frame unless it is given."""
    match slot.role:
        case "length":
            return message.formula.at(count)
        case "id":
            return message.id_of(slot)
        case "count" | "size" if message.items is not None:
            return _checked(slot, slot.name, message.items.counted(slot, count))
        case _:
            return _checked(slot, path, numbers[path])


def _numbers(message: MessageLayout, values: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
    """Return the given numbers by path (`targets[0].position`), and the count of the frame."""
    expected = {argument.name for argument in message.arguments}
    counter = message.frame.counter
    given = {counter.name: 0, **values} if counter is not None else values
    for name in sorted(given.keys() ^ expected):
        raise Unencodable(
            f"`{name}` is missing"
            if name in expected
            else f"{message.name} has no field `{name}` to be given"
        )
    count = message.counts[0]
    numbers: dict[str, Any] = {}
    for slot in message.arguments:
        value = given[slot.name]
        match slot:
            case Number():
                if value is not None or not slot.optional:
                    numbers[slot.name] = value
            case Text():
                numbers[slot.name] = value
            case Packed():
                numbers[slot.name] = _packed(slot, value)
            case Items():
                items = _listed(slot, value)
                if slot is message.items:
                    count = len(items)
                for index, item in enumerate(items):
                    numbers |= _element(slot, index, item)
    return _optional(message, numbers) if message.optional else count, numbers


def _optional(message: MessageLayout, numbers: Mapping[str, object]) -> int:
    """Return the count of a frame whose optional fields are those among `numbers`."""
    given = [slot.name for slot in message.optional if slot.name in numbers]
    for count in message.counts:
        if given == [slot.name for slot in message.there(count) if slot in message.optional]:
            return count
    named = ", ".join(given) or "none of them"
    raise Unencodable(f"{message.name} has no frame with {named} of its optional fields")


def _packed(packed: Packed, value: Any) -> list[int]:
    if not isinstance(value, list):
        raise Unencodable(f"{packed.name} must be a list")
    if len(value) != packed.count:
        raise Unencodable(f"{packed.name}: {len(value)} numbers, and it has {packed.count}")
    for index, number in enumerate(value):
        path = f"{packed.name}[{index}]"
        if not isinstance(number, int) or isinstance(number, bool):
            raise Unencodable(f"{path}: {number!r} is not a whole number")
        if not packed.low <= number <= packed.high:
            raise Unencodable(f"{path}: {number} is outside {packed.low}..{packed.high}")
    return value


def _listed(slot: Items, value: Any) -> list[Any]:
    """Return the elements of a list that is given; those of text are its characters."""
    if slot.text is not None:
        value = list(_encoded(slot.name, slot.text, value))
    if not isinstance(value, list):
        raise Unencodable(f"{slot.name} must be a list")
    if not slot.low <= len(value) <= slot.high:
        bounds = f"{slot.low}..{slot.high}"
        raise Unencodable(f"{slot.name}: {len(value)} items is outside {bounds}")
    return value


def _encoded(path: str, charset: str, value: Any) -> bytes:
    if not isinstance(value, str):
        raise Unencodable(f"{path} must be text")
    try:
        return value.encode(charset)
    except UnicodeEncodeError as error:
        raise Unencodable(f"{path}: {value[error.start]!r} is not {charset}") from None


def _text(text: Text, path: str, value: Any) -> bytes:
    data = _encoded(path, text.charset, value)
    if len(data) > text.size:
        raise Unencodable(f"{path}: {len(data)} characters, and it has room for {text.size}")
    return text.write(value)


def _element(items: Items, index: int, item: Any) -> dict[str, object]:
    if items.element is None:
        return {f"{items.name}[{index}]": item}
    names = [field.name for field in items.fields]
    if not isinstance(item, dict) or set(item) != set(names):
        raise Unencodable(f"{items.name}[{index}] must have the keys {', '.join(names)}")
    return {items.path(index, field): item[field.name] for field in items.fields}


def _checked(number: Number, path: str, value: object) -> float:
    if number.is_float:
        return _floating(number, path, value)
    if not isinstance(value, int) or isinstance(value, bool):
        raise Unencodable(f"{path}: {value!r} is not a whole number")
    if not number.holds(value):
        raise Unencodable(f"{path}: {value} is outside {number.low}..{number.high}")
    return value


def _floating(number: Number, path: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise Unencodable(f"{path}: {value!r} is not a number")
    try:
        number.write(value)
    except OverflowError:
        raise Unencodable(f"{path}: {value} is no {number.number_type.name}") from None
    return value
