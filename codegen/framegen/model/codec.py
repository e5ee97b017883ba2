"""The reference codec: encodes and decodes by walking the layout, slowly and plainly.

It executes the examples of a spec, explains frames and writes the test vectors. The generated
libraries are held to what it says, and share no code with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.wording import describe_range

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout, Repeat, WireField
    from framegen.model.model import Model

# The reasons for which bytes are no frame. Every target and the test vectors use these words.
TOO_SHORT = "too short"
TRAILING_BYTES = "trailing bytes"
BAD_HEADER = "bad header"
LENGTH_MISMATCH = "length mismatch"
COUNT_MISMATCH = "count mismatch"
UNKNOWN_COMMAND = "unknown command"
OUT_OF_RANGE = "out of range"


@dataclass(frozen=True, slots=True)
class Decoded:
    """A frame understood: its layout and the values of its fields, without the count."""

    layout: MessageLayout
    values: dict[str, Any]


class NotAFrame(ValueError):  # noqa: N818 - says what the bytes are
    """Bytes that are no frame: the reason, the offset where it shows, and what was expected."""

    def __init__(self, reason: str, offset: int, expected: str) -> None:
        super().__init__(f"{reason} at byte {offset}: {expected}")
        self.reason = reason
        self.offset = offset
        self.expected = expected


class Unencodable(ValueError):  # noqa: N818 - says what the values are
    """Values that no frame can carry."""


def decode(model: Model, direction: Direction, data: bytes) -> Decoded:
    """Understands exactly one frame. Raises NotAFrame."""
    frame = model.frame
    for offset, byte in enumerate(frame.header):
        if offset == len(data):
            raise NotAFrame(TOO_SHORT, offset, f"a frame begins {frame.header.hex(' ').upper()}")
        if data[offset] != byte:
            raise NotAFrame(BAD_HEADER, offset, f"a frame begins {frame.header.hex(' ').upper()}")
    if len(data) < frame.body_at:
        raise NotAFrame(TOO_SHORT, len(data), f"the shortest frame has {frame.body_at} bytes")
    length = read_number(model, data, frame.length_at, frame.length.size)
    code = read_number(model, data, frame.id_at, frame.id.size)
    message = model.sent(direction).get(code)
    if message is None:
        raise NotAFrame(
            UNKNOWN_COMMAND, frame.id_at, f"no message {direction} has the {frame.id_name} {code}"
        )
    if length not in message.lengths:
        raise NotAFrame(
            LENGTH_MISMATCH,
            frame.length_at,
            f"{message.name} has a {frame.length_name} of {describe_range(message.lengths)}, "
            f"not {length}",
        )
    size = length + frame.uncounted
    if len(data) < size:
        raise NotAFrame(
            TOO_SHORT, len(data), f"a {frame.length_name} of {length} makes {size} bytes"
        )
    if len(data) > size:
        raise NotAFrame(
            TRAILING_BYTES, size, f"a {frame.length_name} of {length} makes {size} bytes"
        )
    return Decoded(message, _values(model, message, data, length))


def _values(model: Model, message: MessageLayout, data: bytes, length: int) -> dict[str, Any]:
    count = message.formula.count_at(length)
    if count is None:
        raise AssertionError("a legal length has a count")
    numbers: dict[str, int] = {}
    for path, offset, field in message.fields_of(count):
        value = read_number(model, data, offset, field.wire.size, signed=field.wire.low < 0)
        if message.counts_with(field) and value != count:
            raise NotAFrame(
                COUNT_MISMATCH,
                offset,
                f"a {message.frame.length_name} of {length} makes {field.name} {count}, "
                f"not {value}",
            )
        if not field.low <= value <= field.high:
            raise NotAFrame(
                OUT_OF_RANGE, offset, f"{path} is {value}, outside {field.low}..{field.high}"
            )
        numbers[path] = value
    return _gathered(message, numbers, count)


def _gathered(message: MessageLayout, numbers: dict[str, int], count: int) -> dict[str, Any]:
    """Numbers by path (`targets[0].position`) as values by field."""
    values: dict[str, Any] = {
        f.name: numbers[f.name] for f in message.numbers if not message.counts_with(f)
    }
    repeat = message.repeat
    if repeat is None:
        return values
    if repeat.element is None:
        values[repeat.name] = [numbers[f"{repeat.name}[{index}]"] for index in range(count)]
    else:
        values[repeat.name] = [
            {field.name: numbers[f"{repeat.name}[{index}].{field.name}"] for field in repeat.fields}
            for index in range(count)
        ]
    return values


def encode(model: Model, message: MessageLayout, values: dict[str, Any]) -> bytes:
    """Encode the frame that carries `values`, keyed by field. Raises Unencodable."""
    expected = {argument.name for argument in message.arguments}
    for name in sorted(values.keys() ^ expected):
        raise Unencodable(
            f"`{name}` is missing"
            if name in expected
            else f"{message.name} has no field `{name}` to be given"
        )
    body = b""
    repeat = message.repeat
    items: list[Any] = []
    if repeat is not None:
        if not isinstance(values[repeat.name], list):
            raise Unencodable(f"{repeat.name} must be a list")
        items = values[repeat.name]
        if len(items) not in message.counts:
            raise Unencodable(
                f"{repeat.name}: {len(items)} items is outside {repeat.low}..{repeat.high}"
            )
    for field in message.numbers:
        body += _number(
            model,
            field,
            field.name,
            len(items) if message.counts_with(field) else values[field.name],
        )
    if repeat is not None:
        body += b"".join(_element(model, repeat, index, item) for index, item in enumerate(items))
    frame = model.frame
    data = bytearray(frame.body_at)
    data[: len(frame.header)] = frame.header
    length = len(body) + frame.counted
    data[frame.length_at : frame.length_at + frame.length.size] = _number_bytes(
        model, length, frame.length.size
    )
    data[frame.id_at : frame.id_at + frame.id.size] = _number_bytes(
        model, message.id, frame.id.size
    )
    return bytes(data) + body


def _element(model: Model, repeat: Repeat, index: int, item: Any) -> bytes:
    path = f"{repeat.name}[{index}]"
    if repeat.element is None:
        return _number(model, repeat.fields[0], path, item)
    names = [field.name for field in repeat.fields]
    if not isinstance(item, dict) or set(item) != set(names):
        raise Unencodable(f"{path} must have the keys {', '.join(names)}")
    return b"".join(
        _number(model, field, f"{path}.{field.name}", item[field.name]) for field in repeat.fields
    )


def _number(model: Model, field: WireField, path: str, value: object) -> bytes:
    if not isinstance(value, int) or isinstance(value, bool):
        raise Unencodable(f"{path}: {value!r} is not a whole number")
    if not field.low <= value <= field.high:
        raise Unencodable(f"{path}: {value} is outside {field.low}..{field.high}")
    return _number_bytes(model, value, field.wire.size, signed=field.wire.low < 0)


def _number_bytes(model: Model, value: int, size: int, *, signed: bool = False) -> bytes:
    return value.to_bytes(size, model.spec.byte_order, signed=signed)


def read_number(model: Model, data: bytes, offset: int, size: int, *, signed: bool = False) -> int:
    """Read the number of `size` bytes at `offset`, in the byte order of the protocol."""
    return int.from_bytes(data[offset : offset + size], model.spec.byte_order, signed=signed)
