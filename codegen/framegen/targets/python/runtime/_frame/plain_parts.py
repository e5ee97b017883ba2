"""The parts of a frame, for people: the bytes of each, what it is called, and what it says."""

from __future__ import annotations

from .protocol import (
    BODY_AT,
    COMMAND_AT,
    COMMAND_END,
    COMMAND_NAME,
    HEADER,
    HEADER_NAME,
    LENGTH_AT,
    LENGTH_END,
    LENGTH_NAME,
    read_command,
    read_length,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import TypeAlias

    from .message import Message
    from .number import Number

    # The bytes of a part, what it is called, and what it says.
    Cell: TypeAlias = tuple[bytes, str, str]


def message_parts(message: Message) -> Iterator[Cell]:
    """Yield the parts of a message: its head, its numbers, and the elements of its list."""
    frame, items = message.encode(), message.SHAPE.items
    yield from _head(frame)
    at = BODY_AT
    for number in message.SHAPE.numbers:
        size = number.struct.size
        yield frame[at : at + size], number.name, _says(number, frame, at)
        at += size
    position = 0
    while items is not None and at < len(frame):
        begun, said = at, []
        for number in items.fields:
            name = "" if items.element is None else f"{number.name} "
            said.append(f"{name}{_says(number, frame, at)}")
            at += number.struct.size
        yield frame[begun:at], f"{items.name}[{position}]", ", ".join(said)
        position += 1


def unknown_parts(frame: bytes) -> list[Cell]:
    """Return the parts of a frame of unknown command."""
    return [*_head(frame), (frame[BODY_AT:], "parameters", "")]


def _head(frame: bytes) -> list[Cell]:
    """Return the parts that stand in front of the parameters."""
    parts = [
        (0, HEADER, HEADER_NAME, ""),
        (LENGTH_AT, frame[LENGTH_AT:LENGTH_END], LENGTH_NAME, str(read_length(frame))),
        (COMMAND_AT, frame[COMMAND_AT:COMMAND_END], COMMAND_NAME, str(read_command(frame))),
    ]
    return [(data, name, says) for _, data, name, says in sorted(parts)]


def _says(number: Number, frame: bytes, at: int) -> str:
    """Return what a number says: its value with its name or its unit."""
    (value,) = number.struct.unpack_from(frame, at)
    for name, meant in number.names.items():
        if meant == value:
            return f"{value} ({name})"
    return f"{value} {number.unit}" if number.unit else str(value)
