"""Shows bytes in a notebook: a strip of cells, what each part is, and what it says."""

from __future__ import annotations

from html import escape

from .bytes_like import format_hex
from .pluralize import pluralize
from .protocol import (
    BODY_AT,
    COMMAND_AT,
    COMMAND_END,
    HEADER,
    LENGTH_AT,
    LENGTH_END,
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

# So many parts, and bytes of one part, are shown; whoever wants all has `encode()`.
_MOST_CELLS = 48
_MOST_BYTES = 64

_TABLE = "border-collapse:collapse;font-family:monospace;text-align:left"
_CELL = "border:1px solid;padding:2px 6px;text-align:left"
# The colours are the notebook's own, light or dark.
_HEAD = f"{_CELL};font-weight:normal;white-space:nowrap;opacity:.75"


def message_strip(message: Message) -> str:
    """Return a message as HTML: its frame, field by field."""
    way = message.DIRECTION
    frame = message.encode()
    title = f"{type(message).__name__}, {way.sender} to {way.receiver}"
    return _strip(title, frame, [*_head(frame), *_fields(message)])


def noise_strip(title: str, data: bytes, *, is_frame: bool) -> str:
    """Return noise as HTML: a run of bytes or, where it has the shape of a frame, its parts."""
    cells = [*_head(data), (data[BODY_AT:], "parameters", "")] if is_frame else [(data, "", "")]
    return _strip(title, data, cells)


def _head(frame: bytes) -> list[Cell]:
    """Return the parts that stand in front of the parameters."""
    parts = [
        (0, HEADER, "header", ""),
        (LENGTH_AT, frame[LENGTH_AT:LENGTH_END], "length", str(read_length(frame))),
        (COMMAND_AT, frame[COMMAND_AT:COMMAND_END], "command", str(read_command(frame))),
    ]
    return [(data, name, says) for _, data, name, says in sorted(parts)]


def _fields(message: Message) -> Iterator[Cell]:
    """Return the parts behind those: the numbers, and the elements of the list."""
    frame, items = message.encode(), message.SHAPE.items
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


def _says(number: Number, frame: bytes, at: int) -> str:
    """Return what a number says: its value with its name or its unit."""
    (value,) = number.struct.unpack_from(frame, at)
    for name, meant in number.names.items():
        if meant == value:
            return f"{value} ({name})"
    return f"{value} {number.unit}" if number.unit else str(value)


def _strip(title: str, data: bytes, cells: list[Cell]) -> str:
    """Return cells as a table: their bytes, below them their names, and what they say."""
    shown = cells[:_MOST_CELLS]
    left = sum(len(part) for part, _, _ in cells[_MOST_CELLS:])
    if left:
        shown.append((b"", f"and {pluralize(left, 'byte')} more", ""))
    rows = [
        _row("th", _HEAD, [name for _, name, _ in shown]),
        _row("td", _CELL, [_bytes(part) for part, _, _ in shown]),
        _row("td", _CELL, [says for _, _, says in shown]),
    ]
    table = "".join(row for row in rows if row)
    caption = f"<div>{escape(title)}, {pluralize(len(data), 'byte')}</div>"
    scrolled = f'<div style="overflow-x:auto"><table style="{_TABLE}">{table}</table></div>'
    return f"<div>{caption}{scrolled}</div>"


def _bytes(part: bytes) -> str:
    text = format_hex(part[:_MOST_BYTES])
    left = len(part) - _MOST_BYTES
    return f"{text} and {pluralize(left, 'byte')} more" if left > 0 else text


def _row(tag: str, style: str, texts: list[str]) -> str:
    """Return a row; none where it says nothing."""
    cells = "".join(f'<{tag} style="{style}">{escape(text)}</{tag}>' for text in texts)
    return f"<tr>{cells}</tr>" if any(texts) else ""
