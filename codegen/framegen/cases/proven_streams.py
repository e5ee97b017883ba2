"""Streams of frames with a checksum: wrong ones, and much that only it tells from frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.sender import LONGEST
from framegen.cases.stream_case import QUIET, StreamCase, chunks, single_bytes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.sender import Sender
    from framegen.cases.stream_case import Parts

# So many beginnings of frames reach across several of the frames that they claim to be.
_RUN = 12


def proven_streams(sender: Sender) -> Iterator[StreamCase]:
    """Yield these streams, where frames of this kind have a checksum."""
    frames = [*sender.small_frames.values()]
    if not frames or not sender.frame.proven:
        return
    for title, parts in [*_runs(sender, frames[0]), *_unknown(sender, frames[0])]:
        yield StreamCase(title, sender.direction, parts)


def _runs(sender: Sender, frame: bytes) -> Iterator[tuple[str, Parts]]:
    """Yield runs of what begins a large frame as well as can be."""
    large, _ = sender.frames_around(LONGEST)
    if large is None or len(large) <= sender.frame.body_at + 1:
        return
    begun = large[: sender.frame.body_at] * _RUN
    yield "a run of beginnings of a large frame, then a frame", (begun + frame, QUIET)
    pieces = chunks(begun + frame, 7)
    yield "a run of beginnings of a large frame, then a frame, in pieces", (*pieces, QUIET)
    behind = begun + large + frame
    yield "a run of beginnings of a large frame, then all of it", (behind, QUIET)


def _unknown(sender: Sender, frame: bytes) -> Iterator[tuple[str, Parts]]:
    """Yield frames of an unknown id whose checksum is wrong, by what they hold."""
    held = {"": sender.noise(2), " that holds a frame": sender.noise(1) + frame}
    for what, body in held.items():
        unknown = sender.unknown(body)
        if unknown is None:
            continue
        title = f"an unknown frame of a wrong checksum{what}"
        wrong = unknown[:-1] + bytes([unknown[-1] ^ 0x01])
        yield f"{title}, then quiet", (wrong, QUIET)
        yield f"{title}, then a frame", (wrong + frame, QUIET)
        yield f"{title}, byte by byte", (*single_bytes(wrong + frame), QUIET)
