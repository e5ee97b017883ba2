"""Draws of each kind of property depend on no order, and on nothing that is imported."""

import os
import sys
from pathlib import Path
from textwrap import dedent

import pytest

from tests.programs import ran

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
