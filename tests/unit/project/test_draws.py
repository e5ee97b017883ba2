"""What Hypothesis draws depends on the test alone, and a failing example is soon made smaller."""

import os
import sys
from pathlib import Path
from textwrap import dedent
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.internal.conjecture import engine

from tests.draws import SHRINKING_SECONDS
from tests.programs import ran

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


# A module imports one of two others. Of properties, there is one of each kind: what is drawn from
# most, what has parameters by a mark or by a fixture, steps.
PROPERTIES = """
    import importlib
    import os

    import pytest
    from hypothesis import given, strategies as st
    from hypothesis.stateful import RuleBasedStateMachine, rule

    importlib.import_module(os.environ["IMPORTED"])

    ANYTHING = st.integers() | st.text() | st.binary() | st.floats()

    @pytest.fixture(params=["one", "another"], scope="module")
    def which(request):
        return request.param

    @given(st.lists(ANYTHING))
    def test_values(values): pass

    @pytest.mark.parametrize("mark", ["one", "another"])
    @given(data=st.data())
    def test_a_mark(mark, data): data.draw(ANYTHING)

    @given(data=st.data())
    def test_a_fixture(which, data): data.draw(ANYTHING)

    class Machine(RuleBasedStateMachine):
        @rule(value=ANYTHING)
        def take(self, value): pass

    TestSteps = Machine.TestCase
"""
FILES = {
    # Constants as Hypothesis would look for them.
    "one_of_ours.py": "A, B, C = 123456789, 'the text of one', b'bytes of one'\n",
    "another_of_ours.py": "A, B, C = 987654321, 'the text of another', b'bytes of another'\n",
    "test_some.py": PROPERTIES,
    "test_others.py": "from test_some import test_values as test_others\n",
    # As tests/conftest.py has it, without all that takes longer.
    "conftest.py": """
        from hypothesis import settings
        from tests.draws import draw_the_same

        settings.register_profile("same", derandomize=True, max_examples=5, deadline=None)
        settings.load_profile("same")

        def pytest_sessionstart(session): draw_the_same()
    """,
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with two files of properties."""
    made = tmp_path_factory.mktemp("draws")
    for name, text in FILES.items():
        (made / name).write_text(dedent(text), encoding="utf-8")
    return made


def drawn(folder: Path, options: str, imported: str, hash_seed: int) -> list[str]:
    """Return the digests of a new process that has imported so much before."""
    path = os.pathsep.join([*sys.path, str(folder)])
    environment = {"PYTHONPATH": path, "PYTHONHASHSEED": str(hash_seed), "IMPORTED": imported}
    command = [sys.executable, "-m", "pytest", "-c", os.devnull, "--rootdir", str(folder)]
    plugins = ["-p", "tests.draws", "-p", "no:cacheprovider"]
    done = ran(*command, *plugins, *options.split(), cwd=folder, environment=environment)
    return [line for line in done.stdout.splitlines() if line.startswith("drawn: ")]


def test_draws_depend_on_no_order_and_on_nothing_that_is_imported(folder: Path) -> None:
    there = drawn(folder, "-n 0", "one_of_ours", 1)
    assert there[-1].endswith(" by all 7 of them")
    assert drawn(folder, "-n 0 --shuffled 7", "another_of_ours", 2) == there
