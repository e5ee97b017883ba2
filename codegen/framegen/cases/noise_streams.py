"""Streams with noise, and with frames that arrive in pieces."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.invalid import slots_once, spoilt_slot
from framegen.cases.stream_case import QUIET, StreamCase, chunks, single_bytes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.sender import Sender
    from framegen.cases.stream_case import Parts


def noise_streams(sender: Sender) -> Iterator[StreamCase]:
    """Yield streams of noise around frames, false headers, cut frames and illegal lengths."""
    frames = [*sender.small_frames.values()]
    if frames:
        # The second, so that a message more changes nothing here.
        other = frames[:2][-1]
        lines = [
            *_noise(sender, frames[0]),
            *_headers(sender, frames[0]),
            *_cuts(sender, frames[0], other),
            *_lengths(sender, frames[0]),
            *_addresses(sender, frames[0]),
            *_together(frames),
            *_mixed(sender, frames[0], other),
        ]
        for title, parts in lines:
            yield StreamCase(title, sender.direction, parts)


def _noise(sender: Sender, frame: bytes) -> Iterator[tuple[str, Parts]]:
    noise = sender.noise
    yield "nothing but quiet", (QUIET, QUIET)
    yield "noise alone", (noise(5), QUIET)
    yield "noise byte by byte, then a frame", (*single_bytes(noise(4)), frame, QUIET)
    around = noise(3) + frame + noise(1) + frame + noise(4)
    yield "noise in front of, between and behind frames", (around, QUIET)
    yield "noise on both sides of quiet", (noise(2), QUIET, noise(3) + frame, QUIET)
    yield "quiet twice between frames", (frame, QUIET, QUIET, frame, QUIET)


def _headers(sender: Sender, frame: bytes) -> Iterator[tuple[str, Parts]]:
    header, noise = sender.header, sender.noise
    yield "a header alone", (header, QUIET)
    yield "a header at the end of noise", (noise(3) + header, QUIET)
    yield "a header twice, then quiet", (header * 2, QUIET)
    yield "a false header in front of a frame", (header + frame, QUIET)
    yield "two false headers in front of a frame", (header * 2 + frame, QUIET)
    yield "a false header, noise, then a frame", (header + noise(4) + frame, QUIET)
    yield "the first byte of a header seven times, then a frame", (header[:1] * 7 + frame, QUIET)
    if len(header) > 1:
        yield "a header that is cut in two by quiet", (header[:1], QUIET, frame[1:], QUIET)
        yield "the first byte of a header at the end of noise", (noise(2) + header[:1], QUIET)


def _cuts(sender: Sender, frame: bytes, other: bytes) -> Iterator[tuple[str, Parts]]:
    for slot in sender.frame.head + sender.frame.tail:
        end = slot.at + slot.size if slot.at >= 0 else len(frame) + slot.at + slot.size
        if end < len(frame):
            cut = f"a frame cut behind its {slot.name}"
            yield f"{cut}, then another", (frame[:end] + other, QUIET)
            yield f"{cut}, then quiet", (frame[:end], QUIET, other, QUIET)
    yield "a frame that has lost its first byte, then another", (frame[1:] + other, QUIET)
    yield "a frame with a pause in it", (frame[:-1], QUIET, frame[-1:] + other, QUIET)


def _lengths(sender: Sender, frame: bytes) -> Iterator[tuple[str, Parts]]:
    """Yield frames of a known message whose length no frame has."""
    envelope = sender.frame
    if envelope.length_part is None:
        return
    sizes = {
        "less than a frame has": envelope.least - 1,
        "more than a frame has": sender.largest + 1,
        "all that it can": envelope.length.high + envelope.uncounted,
    }
    for said, size in sizes.items():
        wrong = sender.enveloped(sender.known_ids, b"", size)
        if wrong is not None and not envelope.least <= size <= sender.largest:
            yield f"a length that says {said}, then a frame", (wrong + frame, QUIET)
            yield f"a length that says {said}, byte by byte", (*single_bytes(wrong + frame), QUIET)


def _addresses(sender: Sender, frame: bytes) -> Iterator[tuple[str, Parts]]:
    """Yield frames from an address that no device has."""
    name, message = next((name, sender.model.messages[name]) for name in sender.small_frames)
    for placed in slots_once(message, frame):
        if placed.slot.role == "address":
            for title, data in spoilt_slot(sender.model, message, placed, placed.of(frame)):
                wrong = frame[: placed.at] + data + frame[placed.end :]
                yield f"{title} in {name}, then a frame", (message.sealed(wrong) + frame, QUIET)


def _together(frames: list[bytes]) -> Iterator[tuple[str, Parts]]:
    line = b"".join(frames)
    if len(frames) > 1:
        yield "one frame of each message in one piece", (line, QUIET)
        yield "one frame of each message in pieces of 7 bytes", (*chunks(line, 7), QUIET)


def _mixed(sender: Sender, frame: bytes, other: bytes) -> Iterator[tuple[str, Parts]]:
    """Yield mixtures of frames, noise and parts of both, in a pseudo-random order."""
    header = sender.header
    unknown = sender.unknown(sender.noise(2)) or header
    pieces = [
        *(frame, other, header, header[:1], unknown, unknown[:-1], unknown + header[:1]),
        *(frame[:-1], frame[1:], other[: len(header) + 1], sender.noise(2), frame + other),
    ]
    state = 1
    for number in range(1, _MIXED + 1):
        parts: list[bytes | None] = []
        for _ in range(_PIECES):
            state = state * 1103515245 + 12345 & 0x7FFFFFFF
            piece = pieces[(state >> 16) % len(pieces)]
            cut = (state >> 8) % (len(piece) + 1)
            parts += [piece[:cut], piece[cut:]] if 0 < cut < len(piece) else [piece]
        parts.insert(len(parts) // 2, QUIET)
        yield f"bytes of all kinds, {number}", (*parts, QUIET)


_MIXED = 6
_PIECES = 8
