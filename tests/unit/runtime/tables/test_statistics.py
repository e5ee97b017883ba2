"""Statistics of every protocol are those of its decoder's events, however a capture is cut."""

from collections.abc import Iterable, Iterator, Sequence
from io import BytesIO
from itertools import pairwise
from types import ModuleType
from typing import Any

import busservo
import numpy as np
import pytest
from busservo import BatteryVoltage, recordings
from busservo._library import CODEC
from framegen.language.values import Direction
from framewire.command import statistics_sheet
from framewire.explain.words import scaled
from framewire.tables.by_entry import events_by_entry
from framewire.tables.stats import statistics
from framewire.tables.stats.timeline import Clockwork, Intervals, Moments, Timeline
from framewire.tables.stats.trace import BUCKETS, Trace
from framewire.tables.stats.traces import Traces
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from tests.few_each import few_each
from tests.handed import handed_by
from tests.protocols.libraries import Libraries, direction_of
from tests.protocols.specs import FILES
from tests.rows import some
from tests.unit.runtime.tables.rows import Row, joined, rows_of_decoder
from tests.unit.runtime.tables.test_other_protocols import lines_of, ways_of

QUICK = {"lxservo", "everything"}
CASES = some(
    [pytest.param(name, way) for name in FILES for way in ways_of(name)],
    lambda name, way: name in QUICK and way is None,
)


each_case = pytest.mark.parametrize(("name", "way"), CASES)


def statistics_of(made: ModuleType, line: bytes, **how: Any) -> Any:
    return statistics.statistics(handed_by(made.__name__).codec, line, form="raw", **how)


def traces_of(made: ModuleType) -> Any:
    library = handed_by(made.__name__)
    return Traces(library.link.bits_per_byte / 9600, library.codec.received)


def sizes(rows: Iterable[Row], by: str) -> dict[str, tuple[int, int]]:
    """Return how many rows there are of each kind, and how many bytes they have."""
    found: dict[str, tuple[int, int]] = {}
    for row in rows:
        count, size = found.get(getattr(row, by), (0, 0))
        found[getattr(row, by)] = (count + 1, size + row.size)
    return found


@each_case
@few_each
@given(data=st.data())
def test_statistics_are_those_of_the_decoder(
    libraries: Libraries, name: str, way: Direction | None, data: st.DataObject
) -> None:
    made = libraries[name]
    line = data.draw(lines_of(name, made))
    direction = None if way is None else direction_of(made, way)
    found = statistics_of(made, line, direction=direction)
    rows = joined(rows_of_decoder(made, line, direction))
    messages = [row for row in rows if row.table not in ("noise", "unknown")]
    counted = {each.name: (each.count, each.size) for each in found.messages}
    assert counted == sizes(messages, "table")
    counted = {each.reason.value: (each.count, each.size) for each in found.noise}
    assert counted == sizes((row for row in rows if row.table == "noise"), "reason")
    unknown = [row for row in rows if row.table == "unknown"]
    assert sum(each.count for each in found.unknown) == len(unknown)
    assert found.size == sum(found.sent.values()) == len(line)
    assert (found.span, found.silences) == (None, [])


def numbers(message: Any) -> Iterator[tuple[str, float]]:
    """Yield the numbers of a message by the paths that statistics give them."""
    for name, value in message.to_dict().items():
        path = name.rstrip("_")
        for element in value if isinstance(value, list) else [value]:
            inner = element if isinstance(element, dict) else {"": element}
            for each, number in inner.items():
                if isinstance(number, int | float):
                    yield f"{path}.{each}".rstrip("._"), number


@pytest.mark.parametrize("name", ["everything", "ubx", "sbus"])
@few_each
@given(data=st.data())
def test_statistics_can_be_shown_and_drawn(
    libraries: Libraries, name: str, data: st.DataObject
) -> None:
    made = libraries[name]
    line = data.draw(lines_of(name, made))
    traces = traces_of(made)
    found = statistics_of(made, line, traces=traces)
    link = handed_by(made.__name__).link
    assert f'"bytes": {len(line)}' in statistics_sheet.as_json(found, 9600, link)
    statistics_sheet.show(found, "line.bin", 9600, link)
    for quantity, lines in traces.panels():
        for trace in lines.values():
            at, value = trace.points()
            assert len(at) == len(value) >= 1, quantity.name


def test_what_is_drawn_is_in_the_larger_unit(libraries: Libraries) -> None:
    made = libraries["crsf"]
    (place,) = (kind for kind in made.MESSAGES if "altitude" in kind.__match_args__)
    given = dict.fromkeys(place.__match_args__, 1) | {"altitude": 1234, "heading": 9050}
    traces = traces_of(made)
    line = place(**given).encode()
    found = statistics_of(made, line, traces=traces)
    drawn = {
        quantity.path: trace.points()[1].tolist()
        for quantity, lines in traces.panels()
        for trace in lines.values()
    }
    assert (drawn["altitude"], drawn["heading"]) == ([234.0], [pytest.approx(90.5)])
    # As whole numbers, values are those on the wire.
    (altitude,) = (each for each in found.ranges if each.quantity.path == "altitude")
    assert (altitude.lowest, altitude.highest) == (1234, 1234)
    assert scaled(altitude.quantity.slot.scale, 1234) == 234


def test_where_nothing_is_measured_other_numbers_are_drawn_first_those_of_the_device() -> None:
    asked, told = busservo.ActionGroupRun(8, 2), busservo.ActionGroupCompleted(8, 2)
    for messages, drawn in (([asked], asked), ([asked, told], told)):
        line = b"".join(each.encode() for each in messages)
        traces = traces_of(busservo)
        statistics_of(busservo, line, traces=traces)
        kinds = {quantity.layout.kind for quantity, _ in traces.panels()}
        assert kinds == {type(drawn)}


# --- Times and gaps ------------------------------------------------------------------------------
READING = BatteryVoltage(7000).encode()


def recording(times: list[float], data: bytes = READING) -> bytes:
    """Return a text recording that does not say when it began."""
    lines = (f"{data.hex(' ')}  # {time:.6f} s, controller: it\n" for time in times)
    return "".join(lines).encode()


def measured(text: bytes) -> statistics.Statistics:
    return statistics.statistics(CODEC, text, form="hex")


def test_times_that_go_back_far_begin_another_recording_and_a_little_do_not() -> None:
    found = measured(recording([1.0, 5.0, 4.5, 4.75, 7.0]))
    assert found.span == statistics.Span(1.0, 7.0, None, 1)
    (readings,) = found.messages
    assert (readings.longest_gap, readings.median_gap) == (4.0, 1.0)
    assert [each.seconds for each in found.silences] == [4.0, 2.0]
    found = measured(recording([1.0, 5.0, 2.0, 2.5]))
    # Four seconds and half a second; nobody knows what lay between.
    assert found.span == statistics.Span(1.0, 5.5, None, 2)
    (readings,) = found.messages
    assert (readings.longest_gap, readings.median_gap) == (4.0, 2.25)


def moments(seconds: NDArray[np.float64], recording: Sequence[int] = ()) -> Moments:
    """Return moments of a recording that does not say when it began."""
    of = np.array([*recording] or [0] * len(seconds))
    return Moments(seconds, of, np.full(len(seconds), np.nan))


def test_the_median_of_many_gaps_counts_all_of_them() -> None:
    found = Intervals()
    now = 0.0
    for gap, count in ((0.001, 5000), (1.5, 1000), (1.5, 1000)):
        seconds = np.linspace(now + gap, now + gap * count, count, dtype=np.float64)
        found.add(moments(seconds))
        now = float(seconds[-1])
    assert found.median is not None
    assert abs(found.median / 0.001 - 1) < 0.01


def test_from_one_recording_to_the_next_is_no_gap() -> None:
    found = Intervals()
    found.add(moments(np.array([0.0, 1.0])))
    found.add(moments(np.array([9.0, 11.0, 50.0]), [1, 1, 2]))
    assert (found.longest, found.median) == (2.0, 1.5)


def test_unknown_frames_of_many_kinds_are_counted_together(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(statistics, "_MOST_UNKNOWN", 2)
    commands = (99, 98, 98, 97, 96, 99, 98)
    frames = b"".join(bytes([0x55, 0x55, 3, command, 1]) for command in commands)
    found = statistics.statistics(CODEC, frames, form="raw")
    assert [(each.numbers, each.count, each.size) for each in found.unknown] == [
        ({"command": 98}, 3, 15),
        ({}, 2, 10),
        ({"command": 99}, 2, 10),
    ]


BEGAN = b"# recorded of 'a line' from 2026-01-0%d 09:08:07.250000 +0000 on\n"
STOP = bytes.fromhex("55 55 02 07")
TWO = BEGAN % 2 + recording([3, 10, 4.5, 10.25, 9.75, 11], STOP)
TWO += BEGAN % 3 + recording([1, 0.5, 1.5], STOP)


@pytest.mark.parametrize("many", [1, 2, 3, 4, 5, 100])
def test_times_that_go_back_stand_still_until_they_are_reached(many: int) -> None:
    clockwork, timeline = Clockwork(), Timeline()
    seconds: list[float] = []
    numbers: list[int] = []
    for stretch in events_by_entry(CODEC, recordings.read(BytesIO(TWO)), many):
        moments = clockwork.moments(stretch)
        assert moments is not None
        timeline.add(stretch, moments)
        seconds += moments.seconds.tolist()
        numbers += moments.recording.tolist()
    assert seconds == [3.0, 10.0, 10.0, 10.25, 10.25, 11.0, 11.0, 11.0, 11.5]
    assert numbers == [0, 0, 0, 0, 0, 0, 1, 1, 1]
    assert (timeline.first, timeline.last, timeline.recordings) == (3.0, 11.5, 2)
    assert [(each.seconds, each.time, each.offset) for each in timeline.silences] == [
        (7.0, 3.0, 4),
        (0.75, 10.25, 20),
        (0.5, 11.0, 32),
        (0.25, 10.0, 12),
    ]


# --- Traces --------------------------------------------------------------------------------------
def test_a_long_trace_keeps_what_can_be_seen_of_it() -> None:
    choose = np.random.default_rng(5)
    seconds = np.cumsum(choose.uniform(0, 0.2, 200_000))
    values = np.sin(seconds / 50) + choose.normal(size=len(seconds)) / 10
    values[120_000], values[60_000] = 40.0, -40.0
    found = Trace()
    for piece in np.array_split(np.arange(len(seconds)), 37):
        found.add(seconds[piece], values[piece])
    at, value = found.points()
    assert found.count == 200_000
    assert BUCKETS <= len(at) <= 4 * BUCKETS
    assert (at[0], value[0], at[-1]) == (seconds[0], values[0], seconds[-1])
    assert value[-1] == values[-1]
    assert (np.diff(at) >= 0).all()
    # Within each stretch of time, the extremes are those of all values.
    edges = np.linspace(seconds[0], seconds[-1], 60)
    width = 2 * (seconds[-1] - seconds[0]) / BUCKETS
    for low, high in pairwise(edges.tolist()):
        inside = values[(seconds >= low) & (seconds < high)]
        wider = value[(at >= low - width) & (at < high + width)]
        assert wider.max() >= inside.max()
        assert wider.min() <= inside.min()
    assert (value.max(), value.min()) == (40.0, -40.0)


def test_a_trace_is_the_same_however_it_is_cut() -> None:
    choose = np.random.default_rng(9)
    seconds = np.cumsum(choose.exponential(1.0, 3000))
    values = np.where(choose.uniform(size=3000) < 0.1, np.nan, choose.normal(size=3000))
    whole = Trace()
    whole.add(seconds, values)
    pieces = Trace()
    for each in range(3000):
        pieces.add(seconds[each : each + 1], values[each : each + 1])
    few_at, few = Trace().points()
    assert len(few_at) == len(few) == 0
    assert pieces.count == whole.count == int((~np.isnan(values)).sum())
    assert np.nanmax(pieces.points()[1]) == np.nanmax(whole.points()[1]) == np.nanmax(values)
    assert np.isnan(pieces.points()[1]).any()
