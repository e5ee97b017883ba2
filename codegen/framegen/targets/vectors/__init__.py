"""Test vectors for codecs in any language: frames with what they mean, and bytes that are no frame.

Made from the spec's examples and the ends of its ranges by the reference codec, never by a
generated library, so that a library can be held to them.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from framegen.language.values import to_hex
from framegen.model.codec import NotAFrame, decode, encode
from framegen.model.layout import Repeat
from framegen.output import banner
from framegen.targets.filenames import file_stem
from framegen.targets.target import Target

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.compile import Compiled
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout, WireField
    from framegen.model.model import Model
    from framegen.targets.target import Snippets


def render(compiled: Compiled, _snippets: Snippets) -> dict[str, str]:
    """The file of vectors, by path below the project's root."""
    model = compiled.model
    protocol = model.spec.protocol
    valid = [vector for message in model.messages.values() for vector in _valid(message)]
    document = {
        "comment": banner(compiled.source.path),
        "protocol": protocol.name,
        "version": protocol.version,
        "valid": valid,
        "invalid": list(_invalid(model)),
    }
    return {f"generated/{file_stem(protocol.name)}/vectors.json": _one_vector_a_line(document)}


def _one_vector_a_line(document: dict[str, Any]) -> str:
    """JSON in which a changed vector is a changed line."""
    parts: list[str] = []
    for key, value in document.items():
        shown = json.dumps(value)
        if isinstance(value, list):
            shown = "[\n" + ",\n".join(f"    {json.dumps(item)}" for item in value) + "\n  ]"
        parts.append(f"  {json.dumps(key)}: {shown}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _valid(message: MessageLayout) -> Iterator[dict[str, Any]]:
    """The examples of a message, then the ends of its ranges."""
    for example in message.message.examples:
        yield _vector(message, example.title, dict(example.values))
    for title, values in _range_ends(message):
        yield _vector(message, title, values)


def _vector(message: MessageLayout, title: str, values: dict[str, Any]) -> dict[str, Any]:
    return {
        "title": title,
        "direction": message.direction.key,
        "message": message.name,
        "fields": values,
        "hex": to_hex(encode(message, values)),
    }


# So many items need two bytes of a count, and of a length: more would show nothing else.
_ENOUGH = 0x100


def _range_ends(message: MessageLayout) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every field at its lowest, then its highest; a list with the fewest items, then with many."""
    if not message.arguments:
        return
    fewest, most = message.counts[0], message.counts[-1]
    many = max(fewest, min(most, _ENOUGH))
    for end, word, count in ("low", "lowest", fewest), ("high", "highest", many):
        values: dict[str, Any] = {}
        for argument in message.arguments:
            if isinstance(argument, Repeat):
                values[argument.name] = [_item(argument, end) for _ in range(count)]
            else:
                values[argument.name] = _end(argument, end)
        shortened = "" if count in (fewest, most) else f", {count} items of up to {most}"
        yield f"every value at its {word}{shortened}", values


def _end(field: WireField, end: str) -> int:
    return field.low if end == "low" else field.high


def _item(repeat: Repeat, end: str) -> Any:
    if repeat.element is None:
        return _end(repeat.fields[0], end)
    return {field.name: _end(field, end) for field in repeat.fields}


def _invalid(model: Model) -> Iterator[dict[str, Any]]:
    """Bytes that are no frame, with the reason: each documented frame, spoilt in every way."""
    for direction in model.directions:
        seen: set[bytes] = set()
        for message in model.sent(direction).values():
            for example in message.message.examples:
                for title, data in _spoilt(model, message, example.hex):
                    if data not in seen:
                        seen.add(data)
                        yield from _refused(model, direction, f"{message.name}: {title}", data)


def _refused(
    model: Model, direction: Direction, title: str, data: bytes
) -> Iterator[dict[str, Any]]:
    try:
        decode(model, direction, data)
    except NotAFrame as error:
        yield {
            "title": title,
            "direction": direction.key,
            "hex": to_hex(data),
            "reason": error.reason,
            "offset": error.offset,
        }


def _spoilt(model: Model, message: MessageLayout, frame: bytes) -> Iterator[tuple[str, bytes]]:
    """A frame with one thing wrong with it. Some are legal frames after all, and are left out."""
    envelope = model.frame
    for size in sorted({0, 1, len(envelope.header), envelope.body_at - 1, len(frame) - 1}):
        yield f"only the first {size} bytes", frame[:size]
    yield "a byte too many", frame + b"\x00"
    yield "a header byte flipped", _changed(frame, len(envelope.header) - 1, 0xFF)
    for step in -1, 1:
        spoilt = _stepped(model, frame, envelope.length_at, envelope.length.size, step)
        yield f"the length off by {step:+}", spoilt
    unknown = next((i for i in envelope.legal_ids if i not in model.sent(message.direction)), None)
    if unknown is not None:
        yield "an unknown command", _replaced(model, frame, envelope.id_at, unknown)
    if message.repeat is not None:
        counter = message.repeat.counter
        for step in -1, 1:
            spoilt = _stepped(model, frame, counter.offset, counter.wire.size, step)
            yield f"the count off by {step:+}", spoilt
    for field in message.numbers:
        if field.narrowed and not message.counts_with(field) and field.high < field.wire.high:
            spoilt = frame[: field.offset] + _bytes(model, field, field.high + 1)
            yield f"{field.name} too high", spoilt + frame[len(spoilt) :]


def _bytes(model: Model, field: WireField, value: int) -> bytes:
    order = model.spec.byte_order
    return value.to_bytes(field.wire.size, order, signed=field.wire.low < 0)


def _changed(frame: bytes, at: int, mask: int) -> bytes:
    return frame[:at] + bytes([frame[at] ^ mask]) + frame[at + 1 :]


def _stepped(model: Model, frame: bytes, at: int, size: int, step: int) -> bytes:
    """The number at `at` changed by `step`, in its lowest byte."""
    last = at if model.spec.byte_order == "little" else at + size - 1
    return frame[:last] + bytes([(frame[last] + step) & 0xFF]) + frame[last + 1 :]


def _replaced(model: Model, frame: bytes, at: int, value: int) -> bytes:
    size = model.frame.id.size
    return frame[:at] + value.to_bytes(size, model.spec.byte_order) + frame[at + size :]


TARGET = Target(
    name="vectors",
    about="Test vectors for codecs in any language.",
    render=render,
)
