"""What Hypothesis draws depends on the test alone, and a failing example is soon made smaller.

test_draws_of_kinds.py compares the draws of processes that have imported other modules.
"""

from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.internal.conjecture import engine

from tests.draws import SHRINKING_SECONDS

KINDS = ("integers", "floats", "bytes", "strings")


@pytest.mark.skipif(not settings().derandomize, reason="a search may draw from all there is")
def test_no_constant_of_a_module_is_drawn() -> None:
    providers = pytest.importorskip("hypothesis.internal.conjecture.providers")
    if hasattr(providers, "_get_local_constants"):
        assert not any(getattr(providers._get_local_constants(), kind) for kind in KINDS)


@pytest.mark.skipif(not settings().derandomize, reason="a search may take its time")
def test_a_failing_example_is_small_within_half_a_minute(monkeypatch: pytest.MonkeyPatch) -> None:
    now, begun = [0.0], list[float]()
    clock = SimpleNamespace(perf_counter=lambda: now[0], monotonic=lambda: now[0])
    monkeypatch.setattr(engine, "time", clock)

    @settings(max_examples=100, database=None)
    @given(st.lists(st.integers(), min_size=20))
    def slow(numbers: list[Any]) -> None:
        now[0] += 1
        if sum(map(abs, numbers)) > 1_000_000:
            begun.append(now[0])
            raise AssertionError(len(numbers))

    with pytest.raises(AssertionError):
        slow()
    assert begun[-1] - begun[0] <= SHRINKING_SECONDS + 10


@st.composite
def even(draw: st.DrawFn, text: str) -> int:
    number = draw(st.integers(0, 99))
    assume(not number % 2)
    return number


@given(even("long " * 20_000))
def test_what_is_long_to_show_may_be_drawn_in_vain(number: int) -> None:
    assert not number % 2
