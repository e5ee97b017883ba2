"""Stream cases: frames among noise, cut, doubled and in pieces, each to show one thing."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from framegen.cases.large_streams import large_streams
from framegen.cases.lengthened_streams import lengthened_streams
from framegen.cases.message_streams import message_streams
from framegen.cases.mixed_streams import mixed_streams
from framegen.cases.noise_streams import noise_streams
from framegen.cases.proven_streams import proven_streams
from framegen.cases.sender import Sender
from framegen.cases.unknown_streams import unknown_streams

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.stream_case import StreamCase
    from framegen.language.values import Direction
    from framegen.model.model import Model

_FAMILIES = (
    message_streams,
    noise_streams,
    unknown_streams,
    proven_streams,
    large_streams,
    lengthened_streams,
)


def streams(model: Model) -> Iterator[StreamCase]:
    """Yield the streams of each direction; one that repeats another is left out."""
    for direction in model.directions:
        seen: set[object] = set()
        for case in _of_one_direction(senders_of(model, direction)):
            line = case.parts, case.max_frame
            if line not in seen:
                seen.add(line)
                yield case


def senders_of(model: Model, direction: Direction) -> list[Sender]:
    """Return what one end sends, by the kinds of its frames."""
    kinds = (each.frame for each in model.candidates([direction]))
    return [Sender(model, direction, frame) for frame in kinds]


def _of_one_direction(senders: list[Sender]) -> Iterator[StreamCase]:
    for sender in senders:
        kind = f"{sender.frame.name}: " if len(senders) > 1 else ""
        for case in (case for family in _FAMILIES for case in family(sender)):
            yield replace(case, title=f"{kind}{case.title}")
    yield from mixed_streams(senders)
