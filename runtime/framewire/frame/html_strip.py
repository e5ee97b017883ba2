"""Shows bytes in a notebook: a strip of cells, what each part is, and what it says."""

from __future__ import annotations

from html import escape

from .bytes_like import format_hex
from .parts import message_parts, unknown_parts
from .pluralize import pluralize

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .envelope import Envelope
    from .message import Message
    from .parts import Cell

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
    title = f"{type(message).__name__}, {way.sender} to {way.receiver}"
    return _strip(title, message.encode(), [*message_parts(message)])


def noise_strip(title: str, data: bytes, envelope: Envelope | None = None) -> str:
    """Return noise as HTML: a run of bytes or, where it has the envelope of a frame, its parts."""
    cells = [(data, "", "")] if envelope is None else [*unknown_parts(envelope, data)]
    return _strip(title, data, cells)


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
