"""Shows a difference: the bytes with their offsets, both answers, and the reference's reason."""

from __future__ import annotations

from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from itertools import accumulate
from typing import TYPE_CHECKING, TypeAlias

from framewire.explain.text import table
from framewire.frame.pluralize import pluralize

from framegen.conformance.language import HEX_AT, Decode, Encode, Stream
from framegen.explain import seen_rows
from framegen.model.codec import Unencodable, encode
from framegen.model.verdict import weigh, weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framewire.explain.explanation import Row

    from framegen.conformance.comparison import Difference
    from framegen.model.model import Model

    # Lines of an answer, each behind the offset of its first byte, if it has any.
    _Lines: TypeAlias = list[tuple[str, str]]

_BYTES_A_LINE = 16
# A line of an answer is shown as far as this; so many lines are, and of these before they differ.
_WIDTH, _LINES, _BEFORE = 200, 40, 10


def strip(model: Model, difference: Difference) -> Iterator[str]:
    """Show a difference in lines of text."""
    question = difference.question
    if isinstance(question, Encode):
        yield from _answers(difference)
        yield ""
        yield from _frame(question)
        return
    reason = _reason(model, difference, question)
    data = question.data if isinstance(question, Decode) else _joined(question.parts)
    yield from _bytes(data, reason.refused_at if reason else None)
    yield ""
    yield from _answers(difference)
    if reason and reason.rows:
        yield ""
        yield from table(reason.rows)
    if reason and reason.refused_at is not None:
        yield ""
        yield f"  {reason.text}"


def _joined(parts: Sequence[bytes | None]) -> bytes:
    return b"".join(part for part in parts if part is not None)


def _bytes(data: bytes, marked: int | None = None) -> Iterator[str]:
    """Show bytes under their offsets, with a mark under one of them, or where it is missing."""
    for start in range(0, len(data), _BYTES_A_LINE):
        line = data[start : start + _BYTES_A_LINE]
        yield "  byte" + "".join(f"{at:>4}" for at in range(start, start + len(line)))
        yield "      " + "".join(f"  {byte:02X}" for byte in line)
        last = start + _BYTES_A_LINE >= len(data)
        if marked is not None and start <= marked < start + _BYTES_A_LINE + last:
            yield "      " + "    " * (marked - start) + "  ^^"


def _answers(difference: Difference) -> Iterator[str]:
    """Show both answers, what they share once, with the byte at which each line begins."""
    end = difference.at + _LINES
    rows = list(_rows(_placed(difference.expected)[:end], _placed(difference.answered)[:end]))
    if difference.failure:
        rows.append(("program", "", f"({difference.failure})"))
    elif not difference.answered:
        rows.append(("program", "", "nothing"))
    if not difference.expected:
        rows.insert(0, ("reference", "", "nothing"))
    start = max(0, difference.at - _BEFORE)
    if start:
        yield f"  ... {pluralize(start, 'line')} before, in which they agree"
    for who, at, line in rows[start : start + _LINES]:
        cut = line if len(line) <= _WIDTH else f"{line[: _WIDTH - 3]}..."
        yield f"  {who:<9}  {at:>4}  {cut}".rstrip()
    if len(rows) > start + _LINES:
        yield "  ... and more"


def _rows(ours: _Lines, theirs: _Lines) -> Iterator[tuple[str, str, str]]:
    matcher = SequenceMatcher(None, ours, theirs, autojunk=False)
    for kind, start, end, other_start, other_end in matcher.get_opcodes():
        if kind == "equal":
            yield from (("both", *line) for line in ours[start:end])
            continue
        yield from (("reference", *line) for line in ours[start:end])
        yield from (("program", *line) for line in theirs[other_start:other_end])


def _placed(lines: Sequence[str]) -> _Lines:
    """Return each line with the offset of its first byte, which follows from the lines before."""
    offsets = accumulate((len(_hex_of(line)) // 2 for line in lines), initial=0)
    return [
        (str(at) if _hex_of(line) else "", line) for at, line in zip(offsets, lines, strict=False)
    ]


def _hex_of(line: str) -> str:
    """Return the bytes of an event, in hex."""
    words = line.split()
    at = HEX_AT.get(words[0], 0) if words and words[0] != "frame" else 0
    return "".join(words[at : at + 1]) if at else ""


def _parting(difference: Difference) -> int:
    """Return the byte at which the events of two streams begin to differ."""
    before = sum(len(_hex_of(line)) // 2 for line in difference.expected[: difference.at])
    one, other = (
        "".join(lines[difference.at : difference.at + 1])
        for lines in (difference.expected, difference.answered)
    )
    # Of noise for the same reason, as far as both have it.
    alike = min(_hex_of(one), _hex_of(other), key=len)
    if one and other and (one.startswith(other) or other.startswith(one)):
        before += len(alike) // 2
    return before


def _rest(parts: Sequence[bytes | None], at: int) -> bytes:
    """Return what is on the line from a byte on, until it goes quiet."""
    stretch = b""
    for part in (*parts, None):
        if part is not None:
            stretch += part
            continue
        if at < len(stretch):
            return stretch[at:]
        at -= len(stretch)
        stretch = b""
    return b""


@dataclass(frozen=True, slots=True)
class _Reason:
    """Why the reference answers so: what agreed with a frame, what did not, and where."""

    rows: Sequence[Row]
    refused_at: int | None
    text: str


def _reason(model: Model, difference: Difference, question: Decode | Stream) -> _Reason | None:
    """Explain what begins where the answers differ; None where nothing does."""
    at = 0
    if isinstance(question, Decode):
        rest = question.data
        verdict = weigh_whole(model, [question.way], rest)
    elif difference.at < len(difference.expected):
        at = _parting(difference)
        rest = _rest(question.parts, at)
        if not rest:
            return None
        verdict = weigh(model, [question.way], rest, question.max_frame)
    else:
        return None
    rows = [replace(row, offset=row.offset + at) for row in seen_rows(model, verdict, rest)]
    if verdict.message is not None:
        return _Reason(rows, None, "")
    verdict = replace(verdict, offset=at + verdict.offset)
    return _Reason(rows, verdict.offset, verdict.refusal)


def _frame(question: Encode) -> Iterator[str]:
    """Yield the expected frame, or why there is none."""
    try:
        frame = encode(question.message, question.values)
    except Unencodable as error:
        yield f"  {error}"
    else:
        yield from _bytes(frame)
