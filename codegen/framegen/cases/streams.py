"""Stream cases: frames among noise, cut, doubled and in pieces, each to show one thing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.large_streams import large_streams
from framegen.cases.message_streams import message_streams
from framegen.cases.noise_streams import noise_streams
from framegen.cases.sender import Sender
from framegen.cases.unknown_streams import unknown_streams

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.stream_case import StreamCase
    from framegen.model.model import Model


def streams(model: Model) -> Iterator[StreamCase]:
    """Yield the streams of each direction; one that repeats another is left out."""
    for direction in model.directions:
        sender = Sender(model, direction)
        seen: set[object] = set()
        for family in message_streams, noise_streams, unknown_streams, large_streams:
            for case in family(sender):
                line = case.parts, case.max_frame
                if line not in seen:
                    seen.add(line)
                    yield case
