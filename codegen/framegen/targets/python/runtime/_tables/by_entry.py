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
    from .found import Seconds

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
        size=sizes.astype(np.uint32),
        kind=np.array([_KINDS[type(entry.event)] for entry in entries], np.int16),
        direction=np.array([_direction(entry) for entry in entries], np.int8),
        time=_times(entries),
        clock=_clocks(entries),
    )


def _stray(entries: list[Entry]) -> Stray:
    found = [(entry, entry.event) for entry in entries if isinstance(entry.event, Noise)]
    frames = [each.data if isinstance(each, UnknownFrame) else None for _, each in found]
    return Stray(
        offset=np.array([entry.offset for entry, _ in found], np.int64),
        size=np.array([len(each.data) for _, each in found], np.int64),
        reason=np.array([_REASONS[each.reason] for _, each in found], np.int8),
        direction=np.array([_direction(entry) for entry, _ in found], np.int8),
        time=_times([entry for entry, _ in found]),
        clock=_clocks([entry for entry, _ in found]),
        frame=frames,
    )


def _size(entry: Entry) -> int:
    event = entry.event
    return len(event.data if isinstance(event, Noise) else event.encode())


def _direction(entry: Entry) -> int:
    return UNKNOWN_SENDER if entry.direction is None else _DIRECTIONS[entry.direction]


def _times(entries: list[Entry]) -> Seconds | None:
    times = [np.nan if entry.time is None else entry.time for entry in entries]
    return _unless_unknown(np.array(times, np.float64))


def _clocks(entries: list[Entry]) -> Seconds | None:
    times = [
        np.nan if entry.time is None or entry.began is None else entry.began + entry.time
        for entry in entries
    ]
    return _unless_unknown(np.array(times, np.float64))


def _unless_unknown(times: Seconds) -> Seconds | None:
    return None if np.isnan(times).all() else times
