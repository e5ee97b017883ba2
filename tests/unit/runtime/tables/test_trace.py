"""Traces: what they keep of many values is what can be seen of them."""

from itertools import pairwise

import numpy as np
from framewire.tables.stats import trace


def test_a_long_trace_keeps_what_can_be_seen_of_it() -> None:
    choose = np.random.default_rng(5)
    seconds = np.cumsum(choose.uniform(0, 0.2, 200_000))
    values = np.sin(seconds / 50) + choose.normal(size=len(seconds)) / 10
    values[120_000], values[60_000] = 40.0, -40.0
    found = trace.Trace()
    for piece in np.array_split(np.arange(len(seconds)), 37):
        found.add(seconds[piece], values[piece])
    at, value = found.points()
    assert found.count == 200_000
    assert trace.BUCKETS <= len(at) <= 4 * trace.BUCKETS
    assert (at[0], value[0], at[-1], value[-1]) == (
        seconds[0],
        values[0],
        seconds[-1],
        values[-1],
    )
    assert (np.diff(at) >= 0).all()
    # Within each stretch of time, the extremes are those of all values.
    edges = np.linspace(seconds[0], seconds[-1], 60)
    width = 2 * (seconds[-1] - seconds[0]) / trace.BUCKETS
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
    whole = trace.Trace()
    whole.add(seconds, values)
    pieces = trace.Trace()
    for each in range(3000):
        pieces.add(seconds[each : each + 1], values[each : each + 1])
    few_at, few = trace.Trace().points()
    assert len(few_at) == len(few) == 0
    assert pieces.count == whole.count == int((~np.isnan(values)).sum())
    assert np.nanmax(pieces.points()[1]) == np.nanmax(whole.points()[1]) == np.nanmax(values)
    assert np.isnan(pieces.points()[1]).any()


def test_values_that_no_line_goes_through_are_known() -> None:
    gap = np.nan
    assert trace.alone(np.array([1.0, gap, 2.0, 3.0, gap, gap, 4.0])).tolist() == [0, 6]
    assert trace.alone(np.array([gap, 5.0, gap])).tolist() == [1]
    assert trace.alone(np.array([1.0, 2.0])).tolist() == trace.alone(np.empty(0)).tolist() == []
    assert trace.alone(np.array([7.0])).tolist() == [0]


def test_two_values_close_to_each_other_are_two_points() -> None:
    found = trace.Trace()
    found.add(np.array([0.0, 1000.0, 1000.001, 2000.0]), np.array([1.0, 5.0, 3.0, 7.0]))
    at, value = found.points()
    assert at.tolist() == [0.0, 1000.0, 1000.001, 2000.0]
    assert value.tolist() == [1.0, 5.0, 3.0, 7.0]
