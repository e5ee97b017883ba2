"""Streams of frames with a checksum: wrong ones, and much that only it tells from frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.sender import LONGEST
from framegen.cases.stream_case import QUIET, StreamCase, chunks, single_bytes
from framegen.model.slots import Constant, Number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.cases.sender import Sender
    from framegen.cases.stream_case import Parts
    from framegen.model.slots import Slot

# So many beginnings of frames reach across several of the frames that they claim to be.
_RUN = 12


def proven_streams(sender: Sender) -> Iterator[StreamCase]:
    """Yield these streams, where frames of this kind have a checksum."""
    frames = [*sender.small_frames.values()]
    if not frames or not sender.frame.proven:
        return
    lines = [
        *_runs(sender, frames[0]),
        *_unknown(sender, frames[0]),
        *_otherwise(sender, frames[0]),
    ]
    for title, parts in lines:
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


def _otherwise(sender: Sender, frame: bytes) -> Iterator[tuple[str, Parts]]:
    """Yield frames of an unknown id with a right checksum, in which another part is wrong."""
    unknown, ids = sender.unknown(sender.noise(2)), sender.unknown_ids
    if unknown is None or ids is None:
        return
    for placed in sender.frame.lay_out(len(unknown)):
        wrong = _wrong(placed.slot)
        # In front of the id, it is refused for itself.
        if wrong is None or placed.at < sender.frame.id.at:
            continue
        changed = unknown[: placed.at] + wrong + unknown[placed.end :]
        sealed = sender.frame.sealed(changed, ids)
        title = f"an unknown frame whose {placed.slot.name} is no such"
        yield f"{title}, then quiet", (sealed, QUIET)
        yield f"{title}, byte by byte, then a frame", (*single_bytes(sealed + frame), QUIET)


def _wrong(slot: Slot) -> bytes | None:
    """Return what no frame has in a constant, or in an address; None where anything can be."""
    if isinstance(slot, Constant) and slot.role == "constant":
        return slot.data[:-1] + bytes([slot.data[-1] ^ 0x01])
    if isinstance(slot, Number) and slot.role == "address":
        beyond = (slot.high + 1, slot.low - 1)
        numbers = (each for each in beyond if each not in slot.named)
        fitting = (each for each in numbers if 0 <= each <= slot.number_type.high)
        return next(map(slot.write, fitting), None)
    return None
