"""Streams with several kinds of frames, each behind and inside of each other."""

from __future__ import annotations

from itertools import permutations
from typing import TYPE_CHECKING

from framegen.cases.stream_case import QUIET, StreamCase, single_bytes

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.cases.sender import Sender
    from framegen.cases.stream_case import Parts


def mixed_streams(senders: Sequence[Sender]) -> Iterator[StreamCase]:
    """Yield these streams of one direction, whose kinds of frames have a sender each."""
    for one, other in permutations([each for each in senders if each.small_frames], 2):
        for title, parts in _lines(one, other):
            yield StreamCase(title, one.direction, parts)


def _lines(one: Sender, other: Sender) -> Iterator[tuple[str, Parts]]:
    (frame, *_), (behind, *_) = one.small_frames.values(), other.small_frames.values()
    name, next_ = one.frame.name, other.frame.name
    yield f"{name}, then {next_}, twice", ((frame + behind) * 2, QUIET)
    yield f"{name}, then {next_}, byte by byte", (*single_bytes(frame + behind), QUIET)
    yield f"{name} without its last byte, then {next_}", (frame[:-1] + behind, QUIET)
    yield f"the header of {name}, then {next_}", (one.header + behind + frame, QUIET)
    head = frame[: one.frame.body_at]
    yield f"the beginning of {name}, then {next_}", (head + behind + frame, QUIET)
    unknown = one.unknown(behind)
    if unknown is not None:
        yield f"an unknown {name} that holds {next_}", (unknown + frame, QUIET)
