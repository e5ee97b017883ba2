"""Recordings behind each other, the gaps in them, and what is counted of noise along them."""

from collections.abc import Sequence

import numpy as np
import pytest
from busservo import BatteryVoltage
from busservo._library import CODEC
from framewire.tables.stats import statistics
from framewire.tables.stats.timeline import Intervals, Moments
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

READING = BatteryVoltage(7000).encode()


def recording(times: list[float], data: bytes = READING) -> bytes:
    """Return a text recording that does not say when it began."""
    lines = (f"{data.hex(' ')}  # {time:.6f} s, controller: it\n" for time in times)
    return "".join(lines).encode()


def measured(text: bytes) -> statistics.Statistics:
    return statistics.statistics(CODEC, text, form="hex")


# --- Recordings behind each other ----------------------------------------------------------------


def test_times_that_go_back_a_little_are_one_recording() -> None:
    found = measured(recording([1.0, 5.0, 4.5, 4.75, 7.0]))
    assert found.span == statistics.Span(1.0, 7.0, None, 1)
    (readings,) = found.messages
    assert (readings.longest_gap, readings.median_gap) == (4.0, 1.0)
    assert [each.seconds for each in found.silences] == [4.0, 2.0]


def test_times_that_go_back_far_begin_another_recording() -> None:
    found = measured(recording([1.0, 5.0, 2.0, 2.5]))
    # Four seconds and half a second; nobody knows what lay between.
    assert found.span == statistics.Span(1.0, 5.5, None, 2)
    (readings,) = found.messages
    assert (readings.longest_gap, readings.median_gap) == (4.0, 2.25)


def test_the_first_of_equally_long_silences_are_shown() -> None:
    found = measured(recording([float(number) for number in range(9)]))
    assert [(each.seconds, each.time, each.offset) for each in found.silences] == [
        (1.0, float(number), len(READING) * (number + 1)) for number in range(5)
    ]


# --- Gaps ----------------------------------------------------------------------------------------


def moments(seconds: NDArray[np.float64], recording: Sequence[int] = ()) -> Moments:
    """Return moments of a recording that does not say when it began."""
    numbers = np.array([*recording] or [0] * len(seconds))
    return Moments(seconds, numbers, np.full(len(seconds), np.nan))


gaps = st.lists(st.sampled_from([0.0, 0.001, 0.02, 1.5, 3000.0]), min_size=1, max_size=40)


@given(gaps, st.integers(1, 7), st.sampled_from([1, 200]))
def test_gaps_are_the_same_however_they_come(between: list[float], size: int, times: int) -> None:
    found = Intervals()
    seconds = np.cumsum([0.0, *between * times])
    for start in range(0, len(seconds), size * times):
        piece = seconds[start : start + size * times]
        found.add(moments(piece))
    every = sorted(np.diff(seconds))
    assert found.longest == every[-1]
    assert found.median is not None
    middle = every[(len(every) - 1) // 2 : len(every) // 2 + 1]
    assert middle[0] * 0.98 - 1e-6 <= found.median <= middle[-1] * 1.02 + 1e-6


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


# --- What is no message --------------------------------------------------------------------------


def test_noise_of_each_line_of_a_recording_is_counted() -> None:
    (noise,) = measured(recording([1.0, 2.0, 3.0], b"\x00\x01")).noise
    assert (noise.reason.value, noise.count, noise.size) == ("bad header", 3, 6)
    # Bytes without times are one stream, however they are written.
    (noise,) = measured(b"00 01\n00 01\n").noise
    assert (noise.count, noise.size) == (1, 4)


def test_unknown_frames_of_too_many_kinds_are_counted_together(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(statistics, "_MOST_UNKNOWN", 2)
    frames = b"".join(
        bytes([0x55, 0x55, 3, command, 1]) for command in (99, 98, 98, 97, 96, 99, 98)
    )
    found = statistics.statistics(CODEC, frames, form="raw")
    assert [(each.numbers, each.count, each.size) for each in found.unknown] == [
        ({"command": 98}, 3, 15),
        ({}, 2, 10),
        ({"command": 99}, 2, 10),
    ]
