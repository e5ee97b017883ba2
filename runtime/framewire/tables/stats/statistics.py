"""What a line carried: counts, shares, rates, gaps and noise, worked out in one pass."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...frame.errors import Reason
from ...recording.layout import layouts_of
from ..reader import BLOCK, events
from ..source import opened
from .excerpted import Excerpted
from .extremes import Ranges
from .noise_count import NoiseCount, NoiseOfReason
from .quantities import readings
from .timeline import Clockwork, Intervals, Timeline

if TYPE_CHECKING:
    from collections.abc import Collection

    from numpy.typing import NDArray

    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.direction import Direction
    from ...recording.excerpt import Excerpt
    from ..events import Events, Frames, NoiseRuns, Numbers
    from ..source import Source
    from .extremes import Extremes
    from .timeline import Moments, Silence
    from .traces import Traces

# So many kinds of unknown frames are told apart.
_MOST_UNKNOWN = 256


@dataclass(frozen=True, slots=True)
class Span:
    """The time of a recording: of the first event and the last, in seconds since it began.

    `clock` is the time of day of the first, in seconds since 1970, where it is known. Times of
    several recordings behind each other are added up.
    """

    first: float
    last: float
    clock: float | None
    recordings: int

    @property
    def seconds(self) -> float:
        """How long it is."""
        return self.last - self.first


@dataclass(frozen=True, slots=True)
class MessageCount:
    """How often a message came, and how many seconds lay between two of them."""

    name: str
    direction: Direction
    count: int
    size: int
    median_gap: float | None
    longest_gap: float | None


@dataclass(frozen=True, slots=True)
class UnknownCount:
    """How often an unknown frame came; `numbers` say which it is, and are empty for all others."""

    numbers: dict[str, int]
    count: int
    size: int


@dataclass(frozen=True, slots=True)
class Statistics:
    """What a line carried.

    `size` is its bytes, `sent` those of each direction, None for bytes that either end may have
    sent. `span` is None where the capture holds no times. `silences` are the longest ones.
    """

    size: int
    sent: dict[Direction | None, int]
    span: Span | None
    messages: list[MessageCount]
    noise: list[NoiseOfReason]
    unknown: list[UnknownCount]
    silences: list[Silence]
    ranges: list[Extremes]

    @property
    def message_count(self) -> int:
        """How many messages there are."""
        return sum(each.count for each in self.messages)

    @property
    def noise_size(self) -> int:
        """How many bytes are noise, those of unknown frames included."""
        return sum(each.size for each in self.noise) + sum(each.size for each in self.unknown)


def statistics(
    codec: ProtocolCodec,
    source: Source,
    *,
    form: str = "auto",
    direction: Direction | None = None,
    traces: Traces | None = None,
    excerpt: Excerpt | None = None,
    ids: Collection[int] | None = None,
) -> Statistics:
    """Return what a line carried, of a capture of any size; its values go into `traces`, too.

    With an `excerpt`, only what came in it counts; raises ExcerptError if that is nothing. With
    `ids`, of quantities that are measured of several numbers only the values of these count. The
    other arguments are those of tables.read, and so are the errors.
    """
    survey, clockwork = _Survey(codec, traces, ids), Clockwork()
    excerpted = None if excerpt is None else Excerpted(excerpt)
    with opened(source, form) as capture:
        for each in events(codec, capture, direction, BLOCK):
            moments = clockwork.moments(each)
            if excerpted is None:
                survey.add(each, moments)
            else:
                survey.add(*excerpted.chosen(each, moments))
    if excerpted is not None:
        excerpted.end()
    return survey.result()


class _Survey:
    """All that is counted, stretch by stretch."""

    def __init__(
        self, codec: ProtocolCodec, traces: Traces | None, ids: Collection[int] | None
    ) -> None:
        layouts = layouts_of(codec)
        self._unknown_frame = codec.unknown_frame
        self._layouts = layouts.every
        self._directions = layouts.directions
        self._traces = traces
        self._ids = None if ids is None else np.array([*ids], np.int64)
        self._count = np.zeros(len(self._layouts), np.int64)
        self._size = np.zeros(len(self._layouts), np.int64)
        self._sent = np.zeros(len(self._directions) + 1, np.int64)
        self._timeline = Timeline()
        self._intervals = [Intervals() for _ in self._layouts]
        self._noise = NoiseCount()
        self._unknown: Counter[tuple[tuple[str, int], ...]] = Counter()
        self._unknown_size: Counter[tuple[tuple[str, int], ...]] = Counter()
        self._ranges = Ranges()

    def add(self, stretch: Events, moments: Moments | None) -> None:
        """Take in a stretch, and when its events came."""
        frames, runs = stretch.frames, stretch.noise
        # One more, so that an unknown sender comes first.
        self._sent += _summed(frames.direction + 1, frames.size, len(self._sent))
        self._sent += _summed(runs.direction + 1, runs.size, len(self._sent))
        self._noise.add(runs)
        self._count_unknown(runs)
        if moments is not None:
            self._timeline.add(stretch, moments)
        self._count += np.bincount(frames.kind, minlength=len(self._count))
        self._size += _summed(frames.kind, frames.size, len(self._size))
        for kind in np.flatnonzero(np.bincount(frames.kind)).tolist():
            which = np.flatnonzero(frames.kind == kind)
            if moments is not None:
                self._intervals[kind].add(moments.chosen(which))
            self._add_values(kind, frames.chosen(which), moments and moments.chosen(which))

    def _add_values(self, kind: int, frames: Frames, moments: Moments | None) -> None:
        for quantity, every in readings(self._layouts[kind], frames):
            values = every
            if self._ids is not None and quantity.key is not None:
                values = every.measured_of(self._ids)
            self._ranges.add(quantity, values)
            if self._traces is not None:
                self._traces.add(quantity, values, frames.offset, moments)

    def _count_unknown(self, runs: NoiseRuns) -> None:
        for frame in runs.frame:
            if frame is not None:
                event = self._unknown_frame(frame, Reason.UNKNOWN_COMMAND)
                key = tuple(event.numbers.items())
                if key not in self._unknown and len(self._unknown) >= _MOST_UNKNOWN:
                    key = ()
                self._unknown[key] += 1
                self._unknown_size[key] += len(frame)

    def result(self) -> Statistics:
        """Return what was counted."""
        timeline = self._timeline
        span = None
        if timeline.first is not None:
            span = Span(timeline.first, timeline.last, timeline.began, timeline.recordings)
        sent = dict(zip((None, *self._directions), self._sent.tolist(), strict=True))
        counted = self._count.tolist(), self._size.tolist(), self._intervals
        return Statistics(
            size=int(self._sent.sum()),
            sent={each: sent[each] for each in (*self._directions, None) if each or sent[each]},
            span=span,
            messages=[
                MessageCount(
                    layout.name, layout.kind.DIRECTION, count, size, gaps.median, gaps.longest
                )
                for layout, count, size, gaps in zip(self._layouts, *counted, strict=True)
                if count
            ],
            noise=self._noise.result(),
            unknown=[
                UnknownCount(dict(key), count, self._unknown_size[key])
                for key, count in sorted(
                    self._unknown.items(), key=lambda item: (-item[1], item[0])
                )
            ],
            silences=timeline.silences,
            ranges=[*self._ranges],
        )


def _summed(places: NDArray[Any], sizes: NDArray[Any], count: int) -> Numbers:
    """Return the sum of the sizes at each place."""
    return np.bincount(places, sizes, minlength=count).astype(np.int64)
