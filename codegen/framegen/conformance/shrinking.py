"""Shrinks a question that is answered wrongly to the smallest one that still is."""

from __future__ import annotations

import sys
from contextlib import suppress
from itertools import chain
from math import isfinite, isnan
from typing import TYPE_CHECKING, Any

from framegen.cases.valid import values_at
from framegen.conformance.language import Decode, Encode, Stream
from framegen.model.codec import Unencodable, encode, values_of
from framegen.model.verdict import weigh

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from framegen.conformance.language import Question
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# What stands between the bytes of a stream.
_QUIET, _CUT = -1, -2
# A byte is lowered by so much, where as many symbols behind it are left out.
_STEPS = (1, 2, 3, 4, 6)


def shrink(
    model: Model, question: Question, differs: Callable[[Question], bool], tries: int
) -> tuple[Question, int]:
    """Find the smallest question for which `differs` holds, and the number of tries.

    It tries smaller questions in turn, and goes on from the first for which it holds, up to `tries`
    times.
    """
    tried = {question.line}
    smaller, weight = _smaller(model, question), _weight(model, question)
    while len(tried) <= tries:
        candidate = next(smaller, None)
        if candidate is None:
            break
        line = candidate.line
        if line in tried or not _weight(model, candidate) < weight:
            continue
        tried.add(line)
        if differs(candidate):
            question = candidate
            smaller, weight = _smaller(model, question), _weight(model, question)
    return question, len(tried) - 1


def _smaller(model: Model, question: Question) -> Iterator[Question]:
    match question:
        case Encode():
            for values in chain(_shorter(question.values), _lower(question.values)):
                yield Encode(question.message, values)
        case Decode(way=way):
            for symbols in _smaller_lines(model, way, list(question.data)):
                yield Decode(way, bytes(symbols))
        case Stream(way=way, max_frame=most):
            yield Stream(way, model.largest([way]), question.parts)
            for symbols in _smaller_lines(model, way, _symbols(question.parts)):
                yield Stream(way, most, _parts(symbols))


def _weight(model: Model, question: Question) -> tuple[int, ...]:
    """Return the size of a question: how much of it there is, then how large its numbers are."""
    match question:
        case Encode():
            numbers = list(_numbers(question.values))
            return len(numbers), *map(_magnitude, numbers)
        case Decode(data=data):
            return len(data), *data
        case Stream(way=way, max_frame=most):
            symbols = _symbols(question.parts)
            count = sum(symbol >= 0 for symbol in symbols)
            odd = most != model.largest([way])
            return count, len(symbols), odd, *symbols


# -- Bytes ---------------------------------------------------------------------------------------


def _symbols(parts: Sequence[bytes | None]) -> list[int]:
    """List bytes and the marks between them as symbols, any of which may be left out."""
    symbols: list[int] = []
    for part in parts:
        if part is None:
            symbols.append(_QUIET)
        else:
            symbols += [_CUT, *part] if symbols and symbols[-1] >= 0 else part
    return symbols


def _parts(symbols: Sequence[int]) -> tuple[bytes | None, ...]:
    parts: list[bytes | None] = [b""]
    for symbol in symbols:
        if symbol == _QUIET:
            parts += [None, b""]
        elif symbol == _CUT:
            parts.append(b"")
        else:
            parts[-1] = (parts[-1] or b"") + bytes([symbol])
    return tuple(part for part in parts if part != b"")


def _smaller_lines(model: Model, way: Direction, symbols: list[int]) -> Iterator[list[int]]:
    for at, end in _runs(symbols):
        yield symbols[:at] + symbols[end:]
    yield from _with_smaller_frames(model, way, symbols)
    for at, end in _runs(symbols):
        yield symbols[:at] + [min(symbol, 0) for symbol in symbols[at:end]] + symbols[end:]
    for at, symbol in enumerate(symbols):
        for value in (1, symbol - 1):
            if 0 <= value < symbol:
                yield [*symbols[:at], value, *symbols[at + 1 :]]
    yield from _lowered(symbols)


def _lowered(symbols: list[int]) -> Iterator[list[int]]:
    """Lower a byte, and leave out as many symbols behind it: a length, and what it counts."""
    for at, symbol in enumerate(symbols):
        for step in _STEPS:
            if symbol >= step:
                lowered = [*symbols[:at], symbol - step, *symbols[at + 1 :]]
                for gap in range(at + 1, len(symbols) - step + 1):
                    yield lowered[:gap] + lowered[gap + step :]


def _runs(items: Sequence[object]) -> Iterator[tuple[int, int]]:
    """Yield the bounds of each half, quarter, ... and of each single symbol."""
    size = len(items)
    while size:
        for at in range(0, len(items) - size + 1, max(1, size // 2)):
            yield at, at + size
        size //= 2


def _with_smaller_frames(model: Model, way: Direction, symbols: list[int]) -> Iterator[list[int]]:
    """Replace a legal frame by a smaller one, of its own or of any message."""
    others = sorted((_least(message) for message in model.sent(way)), key=len)
    for at in range(len(symbols)):
        rest = bytes(symbol for symbol in symbols[at:] if symbol >= 0)
        verdict = weigh(model, [way], rest)
        end = at + verdict.offset
        # A frame that is cut is met again when the cut has gone.
        if verdict.message is None or min(symbols[at:end]) < 0:
            continue
        shorter = _shorter_frames(verdict.message, rest[: verdict.offset])
        for frame in chain([_least(verdict.message)], others, shorter):
            yield symbols[:at] + list(frame) + symbols[end:]


def _shorter_frames(message: MessageLayout, frame: bytes) -> Iterator[bytes]:
    """Yield frames of the same message with fewer elements."""
    for values in _shorter(values_of(message, frame)):
        with suppress(Unencodable):
            yield encode(message, values)


def _least(message: MessageLayout) -> bytes:
    return encode(message, values_at(message, "low", message.counts[0]))


# -- Values --------------------------------------------------------------------------------------


def _magnitude(number: float) -> int:
    return int(abs(number)) if isfinite(number) else sys.maxsize


def _numbers(values: Any) -> Iterator[float]:
    """Yield the numbers among values; of a text, the numbers of its characters."""
    match values:
        case None:
            return
        case str():
            yield from map(ord, values)
        case dict():
            yield from chain.from_iterable(map(_numbers, values.values()))
        case list():
            yield from chain.from_iterable(map(_numbers, values))
        case _:
            yield values


def _shorter(values: Any) -> Iterator[dict[str, Any]]:
    for name, value in values.items():
        if isinstance(value, list | str):
            for at, end in _runs(value):
                # What is left of a list is a list, and of a text a text.
                rest: Any = [value[:at], value[end:]]
                yield {**values, name: rest[0] + rest[1]}


def _lower(value: Any) -> Iterator[Any]:
    match value:
        case dict():
            for name, inner in value.items():
                for lower in _lower(inner):
                    yield {**value, name: lower}
        case list():
            for at, inner in enumerate(value):
                for lower in _lower(inner):
                    yield [*value[:at], lower, *value[at + 1 :]]
        case str() | None:
            return
        case float():
            yield from (lower for lower in (0.0, 1.0) if lower < abs(value) or isnan(value))
        case _:
            towards = 1 if value > 0 else -1
            candidates = (0, towards, abs(value) // 2 * towards, value - towards)
            yield from (lower for lower in candidates if abs(lower) < abs(value))
