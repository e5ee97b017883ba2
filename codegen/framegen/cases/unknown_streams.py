"""Streams with frames of an unknown id, whole and cut short, and with frames inside them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.stream_case import QUIET, StreamCase, single_bytes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.sender import Sender
    from framegen.cases.stream_case import Parts


def unknown_streams(sender: Sender) -> Iterator[StreamCase]:
    """Yield these streams, as far as a frame of this direction has room for their contents."""
    empty = sender.unknown(b"")
    if not sender.small_frames or empty is None:
        return
    frame = next(iter(sender.small_frames.values()))
    filled = _filled(sender) or empty
    lines = [
        *_whole(sender, frame, empty, filled),
        *_holding(sender, frame, empty, filled),
        *_unfinished(sender, frame, empty),
        *_in_a_run(sender),
    ]
    for title, parts in lines:
        yield StreamCase(title, sender.direction, parts)


def _filled(sender: Sender) -> bytes | None:
    """Make an unknown frame that holds up to a few bytes without meaning."""
    found = (sender.unknown(sender.noise(size)) for size in (3, 2, 1))
    return next((each for each in found if each is not None), None)


def _whole(
    sender: Sender, frame: bytes, empty: bytes, filled: bytes
) -> Iterator[tuple[str, Parts]]:
    noise, single = sender.noise, sender.header[:1]
    yield "an unknown frame without fields", (empty, QUIET)
    yield "an unknown frame between frames", (frame + filled + frame, QUIET)
    yield "an unknown frame between noise", (noise(2) + filled + noise(3), QUIET)
    yield "an unknown frame, reported before the line goes quiet", (filled + frame,)
    known = sender.frame.id.at + sender.frame.id.size
    held = "held before the line goes quiet"
    yield f"an unknown frame without its last byte, {held}", (frame + filled[:-1],)
    yield f"an unknown frame cut behind its id, {held}", (frame + filled[:known],)
    yield "an unknown frame byte by byte, then another", (*single_bytes(filled), frame, QUIET)
    yield "two unknown frames", (filled + empty, QUIET)
    yield "an unknown frame behind a single header byte", (single + filled, QUIET)
    yield "an unknown frame without its last byte, then quiet", (filled[:-1], QUIET)
    yield "an unknown frame without its last byte, then a frame", (filled[:-1] + frame, QUIET)
    yield "an unknown frame with a pause in it", (filled[:-1], QUIET, filled[-1:], QUIET)


def _holding(
    sender: Sender, frame: bytes, empty: bytes, filled: bytes
) -> Iterator[tuple[str, Parts]]:
    """Yield whole unknown frames, by what they hold and by what follows them."""
    header, calm = sender.header, sender.noise(1)
    held = {
        "a frame": (frame, b""),
        "the beginning of a frame": (calm + frame[:-1], frame[-1:]),
        "the first byte of a frame": (calm + frame[:1], frame[1:]),
        "a single header byte": (calm + header[:1], frame),
        "a header": (calm + header, b""),
        "an unknown frame": (empty, frame),
        "the beginning of an unknown frame": (calm + filled[:-1], filled[-1:] + frame),
        "an unknown frame and a frame": (empty + frame, b""),
        "a frame and an unknown frame": (frame + empty, b""),
    }
    for what, (body, behind) in held.items():
        unknown = sender.unknown(body)
        if unknown is not None:
            yield f"an unknown frame that holds {what}", (unknown + behind, QUIET)


def _unfinished(sender: Sender, frame: bytes, empty: bytes) -> Iterator[tuple[str, Parts]]:
    """Yield unknown frames whose length claims more than arrives."""
    calm, least = sender.noise(1), sender.frame.least
    more = least + 2 * len(frame) + 2 * len(empty) + 4
    claim, larger = sender.unknown(b"", more), sender.unknown(b"", more + 1)
    if claim is None or larger is None:
        return
    title = "an unknown frame that does not end"
    yield f"{title}, then quiet", (claim + calm, QUIET, frame, QUIET)
    yield f"{title}, with a frame in it", (claim + calm + frame, QUIET)
    yield f"{title}, with a frame reported before the line goes quiet", (claim + frame,)
    frames = single_bytes(claim + frame + calm + frame)
    yield f"{title}, with two frames in it, byte by byte", (*frames, QUIET)
    yield f"{title}, with an unknown frame in it", (claim + empty + calm, QUIET)
    yield f"{title}, with another such and a frame in it", (larger + claim + frame, QUIET)
    claims = single_bytes(larger + claim + empty)
    yield f"{title}, with another such and an unknown frame in it", (*claims, QUIET)


def _in_a_run(sender: Sender) -> Iterator[tuple[str, Parts]]:
    """Yield unknown frames that begin in a run of one byte, which is also their length."""
    first = sender.header[:1]
    run = first[0] + sender.frame.uncounted + 1
    if set(sender.frame.header) == {*first} and run <= sender.largest:
        half = run * 2 // 3
        pieces = half * first, (run - half) * first, bytes(run)
        yield "an unknown frame that begins in a long run of one byte, in pieces", (*pieces, QUIET)
