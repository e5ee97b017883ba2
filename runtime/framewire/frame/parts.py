"""The parts of a frame, for people: the bytes of each, what it is called, and what it says."""

from __future__ import annotations

from .envelope import NumberPart
from .fixed import Always
from .lists import List, size_of
from .number import set_bits
from .optional import Optional
from .packed import Packed
from .text import Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from typing import Any, TypeAlias

    from .envelope import Envelope, Part
    from .message import Message

    # The bytes of a part, what it is called, and what it says.
    Cell: TypeAlias = tuple[bytes, str, str]


def message_parts(message: Message) -> Iterator[Cell]:
    """Yield the parts of a message: those around its fields, and these, element by element."""
    kind, frame = type(message), message.encode()
    envelope = kind.FRAME
    given = [each for each in (envelope.address, envelope.counter) if each is not None]
    outside = {each: getattr(kind, each.name) for each in given}
    yield from _around(envelope.head, frame, outside)
    body = frame[: len(frame) - envelope.tail_size]
    for part in kind.SHAPE.parts:
        yield from _cells(part, body)
    yield from _around(envelope.tail, frame, outside)


def unknown_parts(envelope: Envelope, frame: bytes) -> Iterator[Cell]:
    """Yield the parts of a frame of unknown id that has this envelope."""
    yield from _around(envelope.head, frame, {})
    yield frame[envelope.body_at : len(frame) - envelope.tail_size], _body(envelope), ""
    yield from _around(envelope.tail, frame, {})


def _body(envelope: Envelope) -> str:
    return "parameters" if envelope.ids else "bytes"


def _around(parts: Iterable[Part], frame: bytes, fields: Mapping[Any, Any]) -> Iterator[Cell]:
    """Yield the parts of an envelope; those that a user gives say what their field does.

    `fields` are by part, not by name: a field of the message may be called like a part.
    """
    for part in parts:
        data = frame[part.place]
        says = str(part.read(frame)) if isinstance(part, NumberPart) else ""
        if part in fields:
            says = value_in_words(fields[part], fields[part].struct.unpack(data)[0])
        yield data, part.name, says


def _cells(part: Any, body: bytes) -> Iterator[Cell]:
    """Yield the cells of a part of the fields; none where it is absent."""
    if isinstance(part, List):
        yield from _elements(part, body)
        return
    field = part.number if isinstance(part, Optional) else part
    varies = isinstance(field, Text) and field.least is not None
    size = field.size if isinstance(field, Packed) else 0 if varies else size_of(field)
    data = body[field.at :] if varies else body[field.at : field.at + size]
    if len(data) < size:
        return
    if isinstance(field, Always):
        yield data, field.name, ""
    elif isinstance(field, Packed):
        yield data, field.name, ", ".join(map(str, field.read(data)))
    elif isinstance(field, Text):
        yield data, field.name, repr(field.read(data) if size else str(data, "ascii"))
    else:
        yield data, field.name, value_in_words(field, field.struct.unpack(data)[0])


def _elements(items: List[Any], body: bytes) -> Iterator[Cell]:
    """Yield the elements of a list."""
    fixed = not items.counters and items.least == items.most
    end = items.at + items.most * items.unit_size if fixed else len(body)
    for position, at in enumerate(range(items.at, end, items.unit_size)):
        data = body[at : at + items.unit_size]
        said = []
        for piece in items.pieces:
            if isinstance(piece, Always):
                continue
            found = data[piece.at : piece.at + size_of(piece)]
            name = "" if items.element is None else f"{piece.name} "
            if isinstance(piece, Text):
                said.append(f"{name}{piece.read(found)!r}")
            else:
                said.append(f"{name}{value_in_words(piece, piece.struct.unpack(found)[0])}")
        yield data, f"{items.name}[{position}]", ", ".join(said)


def value_in_words(number: Any, value: float) -> str:
    """Return what a number says: its value with its name, its named bits that are set, its unit."""
    for name, meant in number.names.items():
        if meant == value:
            return f"{value} ({name})"
    bits = getattr(number, "bits", {})
    names = set_bits(int(value), bits) if bits else []
    if names:
        return f"{value} ({', '.join(names)})"
    return f"{value} {number.unit}" if number.unit else str(value)
