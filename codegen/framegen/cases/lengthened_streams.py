"""Streams with frames that begin as those of shorter messages: which one it is shows behind it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.lengthened import lengthened
from framegen.cases.stream_case import QUIET, StreamCase, single_bytes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.sender import Sender
    from framegen.cases.stream_case import Parts


def lengthened_streams(sender: Sender) -> Iterator[StreamCase]:
    """Yield streams for each pair of messages of one kind of frame."""
    for each in lengthened(sender.model):
        if each.long.frame is sender.frame and each.long.direction == sender.direction:
            for title, parts in _lines(each.beginning, each.data):
                named = f"{each.long.name} that begins as {each.short.name}: {title}"
                yield StreamCase(named, sender.direction, parts)


def _lines(short: bytes, long: bytes) -> Iterator[tuple[str, Parts]]:
    yield "byte by byte", (*single_bytes(long), QUIET)
    yield "in two pieces, the shorter first", (short, long[len(short) :], QUIET)
    yield "its beginning alone, then quiet, then whole", (short, QUIET, long, QUIET)
    yield "its beginning alone, held before the line goes quiet", (short,)
    yield "without its last byte, then quiet", (long[:-1], QUIET)
    spoilt = long[:-1] + bytes([long[-1] ^ 0xFF])
    yield "with another last byte, then whole", (spoilt + long, QUIET)
    yield "without what is behind its beginning, then whole", (short + long, QUIET)
