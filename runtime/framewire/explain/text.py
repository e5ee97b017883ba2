"""Explanations as text, and as JSON."""

from __future__ import annotations

from itertools import groupby
from textwrap import fill

from ..frame.pluralize import pluralize

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any

    from .explanation import Explanation, Reading, Refusal, Row

_BYTES_A_LINE = 16
_LINES_AROUND = 2
_WIDTH = 96
_INDENT = " " * len("hint: ")


def as_text(explanation: Explanation) -> str:
    """Write the explanation for a person, without a final newline."""
    if explanation.readings:
        return "\n\n".join("\n".join(_reading(reading)) for reading in explanation.readings)
    return "\n".join(_no_frame(explanation))


def as_json(explanation: Explanation) -> dict[str, Any]:
    """Return the explanation as values that JSON has."""
    return {
        "hex": to_hex(explanation.data),
        "frame": bool(explanation.readings),
        "readings": [
            {
                "message": reading.message,
                "direction": reading.direction,
                "summary": reading.summary,
                "rows": [_row_json(row) for row in reading.rows],
                "facts": dict(reading.facts),
            }
            for reading in explanation.readings
        ],
        "refusals": [
            {
                "direction": refusal.direction,
                "reason": refusal.reason,
                "offset": refusal.offset,
                "expected": refusal.expected,
                "rows": [_row_json(row) for row in refusal.rows],
            }
            for refusal in explanation.refusals
        ],
        "hints": [{"text": hint.text, "frame": to_hex(hint.frame)} for hint in explanation.hints],
    }


def _row_json(row: Row) -> dict[str, Any]:
    return {
        "offset": row.offset,
        "hex": to_hex(row.data),
        "path": row.path,
        "value": row.value,
        "text": row.text,
        "meaning": row.meaning,
    }


def _reading(reading: Reading) -> Iterator[str]:
    yield f"{reading.message}, {reading.direction}"
    yield reading.summary
    yield ""
    yield from table(reading.rows)
    yield ""
    width = max(len(label) for label, _ in reading.facts) + 1
    for label, text in reading.facts:
        yield f"  {label + ':':<{width}} {text}"


def table(rows: Sequence[Row]) -> Iterator[str]:
    """Format rows as columns: offset, bytes, part, value and meaning."""
    cells = [("byte", "hex", "part", "value", "meaning")]
    said: set[str] = set()
    for row in rows:
        # What a field is for is said once, not again for each element of a list.
        meaning = "" if row.meaning in said else _first_sentence(row.meaning)
        said.add(row.meaning)
        cells.append((str(row.offset), to_hex(row.data), row.path, row.text, meaning))
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    for offset, *others in cells:
        padded = [f"{cell:<{width}}" for cell, width in zip(others, widths[1:], strict=True)]
        yield "  ".join([f"  {offset:>{widths[0]}}", *padded]).rstrip()


def _first_sentence(text: str) -> str:
    head, stop, _ = " ".join(text.split()).partition(". ")
    return head if stop else head.removesuffix(".")


def _no_frame(explanation: Explanation) -> Iterator[str]:
    size = len(explanation.data)
    these = "This byte is" if size == 1 else f"These {size} bytes are"
    yield f"{these} no frame of the {explanation.protocol.removeprefix('The ')}."
    for (offset, rows), group in groupby(
        explanation.refusals, key=lambda refusal: (refusal.offset, refusal.rows)
    ):
        yield ""
        yield from _pointed(explanation.data, offset)
        yield from _reasons(list(group))
        # What another direction makes of the same bytes adds little to the closest one.
        if rows and rows == explanation.refusals[0].rows:
            yield ""
            yield "  right up to there:"
            yield from table(rows)
    if explanation.hints:
        yield ""
    for hint in explanation.hints:
        yield fill(f"hint: {hint.text}", _WIDTH, subsequent_indent=_INDENT, break_on_hyphens=False)
        if hint.frame:
            yield f"{_INDENT}{to_hex(hint.frame)}"


def _reasons(refusals: Sequence[Refusal]) -> Iterator[str]:
    said = [f"{refusal.reason}: {refusal.expected}" for refusal in refusals]
    if len(refusals) > 1 and len(set(said)) == 1:
        yield f"  in every direction: {said[0]}"
        return
    for refusal, text in zip(refusals, said, strict=True):
        yield f"  {refusal.direction}: {text}"


def _pointed(data: bytes, offset: int) -> Iterator[str]:
    """Show the bytes around `offset`, with a caret under the one there, or where it is missing."""
    at = offset - offset % _BYTES_A_LINE
    first = max(0, at - _LINES_AROUND * _BYTES_A_LINE)
    end = at + (_LINES_AROUND + 1) * _BYTES_A_LINE
    if first:
        yield f"  ... {pluralize(first, 'byte')} before"
    for start in range(first, end, _BYTES_A_LINE):
        line = data[start : start + _BYTES_A_LINE]
        if line:
            yield f"  {to_hex(line)}"
        if start == at:
            yield f"  {'   ' * (offset - at)}^^ byte {offset}"
    if end < len(data):
        yield f"  ... {pluralize(len(data) - end, 'byte')} after"


def to_hex(data: bytes) -> str:
    """Write bytes as `0A 1B 02 FF`."""
    return data.hex(" ").upper()
