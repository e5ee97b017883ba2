"""Lines to decode: frames among noise, cut, doubled and wrecked, each to show one thing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.cases.invalid import spoilt
from framegen.cases.valid import frames_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# Where the line goes quiet.
QUIET = None


@dataclass(frozen=True, slots=True)
class StreamCase:
    """What arrives, in which pieces, and how large a frame may be, where that has a bound."""

    title: str
    direction: Direction
    parts: tuple[bytes | None, ...]
    max_frame: int | None = None


def streams(model: Model) -> Iterator[StreamCase]:
    """The lines of every message."""
    for message in model.messages.values():
        for title, parts in _lines_of(model, message):
            yield StreamCase(f"{message.name}: {title}", message.direction, parts)


def _lines_of(
    model: Model, message: MessageLayout
) -> Iterator[tuple[str, tuple[bytes | None, ...]]]:
    frame = next(frames_of(message)).data
    yield "byte by byte", (*_single_bytes(frame), QUIET)
    yield "told before the line goes quiet", (frame,)
    for title, data in spoilt(model, message, frame):
        yield f"{title}, then whole", (data + frame, QUIET)


def _single_bytes(data: bytes) -> list[bytes]:
    return [data[at : at + 1] for at in range(len(data))]
