"""Find what a capture holds entry by entry, with the stream decoder: right for any capture."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from .._codec.noise import Noise, UnknownFrame
from .._frame.direction import Direction
from .._frame.errors import Reason
from ..messages import MESSAGES
from .found import UNKNOWN_SENDER, Found, Frames, Stray

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..recordings import Entry

_KINDS: dict[type[object], int] = {kind: number for number, kind in enumerate(MESSAGES)}
_REASONS = {reason: number for number, reason in enumerate(Reason)}
_DIRECTIONS = {direction: number for number, direction in enumerate(Direction)}


def found_by_entry(entries: Iterator[Entry], many: int) -> Iterator[Found]:
    """Yield what the entries of a recording hold, so many entries at once.

    Noise at the end of one stretch may go on in the next.
    """
    while some := [*islice(entries, many)]:
        messages = [entry for entry in some if not isinstance(entry.event, Noise)]
        last = some[-1]
        yield Found(_frames(messages), _stray(some), last.offset + _size(last))


def _frames(entries: list[Entry]) -> Frames:
    data = [entry.event.encode() for entry in entries if not isinstance(entry.event, Noise)]
    sizes = np.array([len(each) for each in data], np.int64)
    return Frames(
        data=np.frombuffer(b"".join(data), np.uint8),
        start=np.cumsum(sizes) - sizes,
        offset=np.array([entry.offset for entry in entries], np.int64),
        size=sizes,
        kind=np.array([_KINDS[type(entry.event)] for entry in entries], np.int64),
        direction=np.array([_direction(entry) for entry in entries], np.int64),
        time=np.array([_time(entry) for entry in entries], np.float64),
        clock=np.array([_clock(entry) for entry in entries], np.float64),
    )


def _stray(entries: list[Entry]) -> Stray:
    found = [(entry, entry.event) for entry in entries if isinstance(entry.event, Noise)]
    frames = [each.data if isinstance(each, UnknownFrame) else None for _, each in found]
    return Stray(
        offset=np.array([entry.offset for entry, _ in found], np.int64),
        size=np.array([len(each.data) for _, each in found], np.int64),
        reason=np.array([_REASONS[each.reason] for _, each in found], np.int64),
        direction=np.array([_direction(entry) for entry, _ in found], np.int64),
        time=np.array([_time(entry) for entry, _ in found], np.float64),
        clock=np.array([_clock(entry) for entry, _ in found], np.float64),
        frame=frames,
    )


def _size(entry: Entry) -> int:
    event = entry.event
    return len(event.data if isinstance(event, Noise) else event.encode())


def _direction(entry: Entry) -> int:
    return UNKNOWN_SENDER if entry.direction is None else _DIRECTIONS[entry.direction]


def _time(entry: Entry) -> float:
    return np.nan if entry.time is None else entry.time


def _clock(entry: Entry) -> float:
    return np.nan if entry.time is None or entry.began is None else entry.began + entry.time
