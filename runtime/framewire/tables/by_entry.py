"""Find what a capture holds entry by entry, with the stream decoder: right for any capture."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from ..codec.event_bytes import bytes_of
from ..codec.noise import Noise, UnknownFrame
from ..recording.layout import REASON_NUMBERS
from .events import UNKNOWN_SENDER, Events, Frames, NoiseRuns

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from ..recording.entry import Entry
    from .events import Seconds


def events_by_entry(codec: ProtocolCodec, entries: Iterator[Entry], many: int) -> Iterator[Events]:
    """Yield what the entries of a recording hold, so many entries at once.

    Noise at the end of one stretch may go on in the next.
    """
    kinds: dict[type[object], int] = {kind: at for at, kind in enumerate(codec.messages)}
    ways: dict[Direction | None, int] = {way: at for at, way in enumerate(codec.directions)}
    ways[None] = UNKNOWN_SENDER
    while True:
        frames, runs = _Rows(ways), _Rows(ways)
        is_unknown: list[bool] = []
        for entry in islice(entries, many):
            event = entry.event
            if isinstance(event, Noise):
                runs.add(entry, REASON_NUMBERS[event.reason.name])
                is_unknown.append(isinstance(event, UnknownFrame))
            else:
                frames.add(entry, kinds[type(event)])
        if not frames.data and not runs.data:
            return
        yield Events(_frames(frames), _runs(runs, is_unknown), max(frames.end, runs.end))


class _Rows:
    """Columns that grow: objects that are not kept need not be collected either."""

    def __init__(self, ways: dict[Direction | None, int]) -> None:
        self._ways = ways
        self.data: list[bytes] = []
        self.offset: list[int] = []
        self.what: list[int] = []
        self.direction: list[int] = []
        self.time: list[float] = []
        self.clock: list[float] = []

    def add(self, entry: Entry, what: int) -> None:
        """Add an entry, with its class or its reason."""
        time, began = entry.time, entry.began
        self.data.append(bytes_of(entry.event))
        self.offset.append(entry.offset)
        self.what.append(what)
        self.direction.append(self._ways[entry.direction])
        self.time.append(np.nan if time is None else time)
        self.clock.append(np.nan if time is None or began is None else began + time)

    @property
    def end(self) -> int:
        """Where the last one ends."""
        return self.offset[-1] + len(self.data[-1]) if self.data else 0


def _frames(rows: _Rows) -> Frames:
    sizes = np.array([len(each) for each in rows.data], np.int64)
    return Frames(
        data=np.frombuffer(b"".join(rows.data), np.uint8),
        start=np.cumsum(sizes) - sizes,
        offset=np.array(rows.offset, np.int64),
        size=sizes.astype(np.uint32),
        kind=np.array(rows.what, np.int16),
        direction=np.array(rows.direction, np.int8),
        time=_unless_unknown(rows.time),
        clock=_unless_unknown(rows.clock),
    )


def _runs(rows: _Rows, is_unknown: list[bool]) -> NoiseRuns:
    pairs = zip(rows.data, is_unknown, strict=True)
    return NoiseRuns(
        offset=np.array(rows.offset, np.int64),
        size=np.array([len(each) for each in rows.data], np.int64),
        reason=np.array(rows.what, np.int8),
        direction=np.array(rows.direction, np.int8),
        time=_unless_unknown(rows.time),
        clock=_unless_unknown(rows.clock),
        frame=[data if unknown else None for data, unknown in pairs],
    )


def _unless_unknown(times: list[float]) -> Seconds | None:
    seconds = np.array(times, np.float64)
    return None if np.isnan(seconds).all() else seconds
