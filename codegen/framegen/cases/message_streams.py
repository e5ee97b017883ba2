"""Streams with the frames of one message: whole, in pieces, repeated, behind noise."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.invalid import slots_once, spoilt_slot
from framegen.cases.stream_case import QUIET, StreamCase, single_bytes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.sender import Sender
    from framegen.cases.stream_case import Parts
    from framegen.model.layout import MessageLayout
    from framegen.model.slots import Placed


def message_streams(sender: Sender) -> Iterator[StreamCase]:
    """Yield the same streams for each message."""
    for name, frame in sender.small_frames.items():
        for title, parts in _lines(sender, sender.model.messages[name], frame):
            yield StreamCase(f"{name}: {title}", sender.direction, parts)


def _lines(sender: Sender, message: MessageLayout, frame: bytes) -> Iterator[tuple[str, Parts]]:
    half = len(frame) // 2
    yield "byte by byte", (*single_bytes(frame), QUIET)
    early = "reported before the line goes quiet"
    yield f"behind noise, {early}", (sender.noise(3) + frame,)
    yield f"behind a single header byte, {early}", (sender.header[:1] + frame,)
    yield "without its last byte, held before the line goes quiet", (frame + frame[:-1],)
    twice = (frame[:half], frame[half:] + frame[:half], frame[half:], QUIET)
    yield "twice, in pieces that end inside of a frame", twice
    yield "without its last byte, then quiet, then whole", (frame[:-1], QUIET, frame, QUIET)
    for placed in slots_once(message, frame):
        if message.frame.body_at < placed.end < len(frame):
            yield f"cut behind {placed.path}, then whole", (frame[: placed.end] + frame, QUIET)
        if placed.slot.role == "reserved":
            other = bytes(byte ^ 0xFF for byte in placed.of(frame))
            data = message.sealed(frame[: placed.at] + other + frame[placed.end :])
            yield f"with another {placed.path}, then as usual", (data + frame, QUIET)
        if _is_own(message, placed):
            yield from _spoilt(sender, message, frame, placed)


def _spoilt(
    sender: Sender, message: MessageLayout, frame: bytes, placed: Placed
) -> Iterator[tuple[str, Parts]]:
    proven = message.frame.proven and placed.slot.role != "checksum"
    for title, data in spoilt_slot(sender.model, message, placed, placed.of(frame)):
        wrong = frame[: placed.at] + data + frame[placed.end :]
        yield f"{title}, then whole", (wrong + frame, QUIET)
        if proven:
            right = message.sealed(wrong)
            yield f"{title} and the checksum of that, then whole", (right + frame, QUIET)


def _is_own(message: MessageLayout, placed: Placed) -> bool:
    """Tell whether a slot is looked at for each message anew.

    What stands in front of all fields is looked at once for all, save how long they are.
    """
    return placed.at >= message.frame.body_at or placed.slot.role == "length"
