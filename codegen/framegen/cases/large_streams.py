"""Streams with the largest frames, and streams with a bound on the size of a frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.sender import LONGEST
from framegen.cases.stream_case import QUIET, StreamCase, chunks

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.sender import Sender
    from framegen.cases.stream_case import Parts

# What a report of USB HID holds, and many a small buffer.
_REPORT = 64


def large_streams(sender: Sender) -> Iterator[StreamCase]:
    """Yield streams with the largest frame, whole and in pieces, then those with a bound."""
    frames = [*sender.small_frames.values()]
    if not frames:
        return
    for title, parts in _largest(sender, frames[0]):
        yield StreamCase(title, sender.direction, parts)
    limit = min(_REPORT, sender.largest - 1)
    if limit >= sender.frame.least:
        bound = f"at most {limit} bytes"
        for title, parts in _bounded(sender, frames[0], limit):
            yield StreamCase(f"{bound}: {title}", sender.direction, parts, limit)


def _largest(sender: Sender, frame: bytes) -> Iterator[tuple[str, Parts]]:
    largest, _ = sender.frames_around(min(sender.largest, LONGEST))
    if largest is None:
        return
    bound = "" if len(largest) == sender.largest else f" of at most {LONGEST} bytes"
    title = f"the largest frame{bound}"
    yield title, (largest, QUIET)
    pieces = chunks(sender.noise(2) + largest + frame, _REPORT)
    yield f"{title}, in pieces of {_REPORT} bytes", (*pieces, QUIET)
    yield f"{title}, behind a single header byte", (sender.header[:1] + largest, QUIET)
    short = largest[:-1]
    yield f"{title}, without its last byte, then another", (short + frame, QUIET)
    yield f"{title}, without its last byte, then quiet", (short, QUIET, frame, QUIET)


def _bounded(sender: Sender, frame: bytes, limit: int) -> Iterator[tuple[str, Parts]]:
    within, beyond = sender.frames_around(limit)
    if within is not None:
        yield f"a frame of {len(within)}", (within + within, QUIET)
    if beyond is not None:
        yield f"a frame of {len(beyond)}, then another", (beyond + frame, QUIET)
        yield f"a frame of {len(beyond)} in pieces", (*chunks(beyond + frame, limit), QUIET)
    least = sender.frame.least
    for size in (limit, limit + 1):
        unknown = sender.unknown(sender.noise(size - least))
        if unknown is not None:
            yield f"an unknown frame of {size}, then another", (unknown + frame, QUIET)
        holding = sender.unknown(sender.noise(size - least - len(frame)) + frame)
        if holding is not None and len(holding) == size:
            yield f"an unknown frame of {size} that holds a frame", (holding, QUIET)
