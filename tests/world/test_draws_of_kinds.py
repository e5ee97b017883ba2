"""Draws of each kind of property depend on no order, and on nothing that is imported."""

from __future__ import annotations

import os
import sys
from subprocess import run
from textwrap import dedent
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

# One of each kind: what is drawn from most, what has parameters by a mark or by a fixture, steps.
PROPERTIES = """
    import importlib
    import os

    import pytest
    from hypothesis import HealthCheck, given, settings, strategies as st
    from hypothesis.stateful import RuleBasedStateMachine, rule

    for name in os.environ["IMPORTED"].split():
        importlib.import_module(name)

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
# Constants of two modules, as Hypothesis would look for them.
MODULES = {
    "one_of_ours": "A, B, C = 123456789, 'the text of one', b'bytes of one'\n",
    "another_of_ours": "A, B, C = 987654321, 'the text of another', b'bytes of another'\n",
}


def drawn(folder: Path, imported: str, hash_seed: int, *options: str) -> list[str]:
    """Return the digest of each property in a new process that has imported so much before."""
    path = os.pathsep.join([*sys.path, str(folder)])
    environment = {"PYTHONPATH": path, "PYTHONHASHSEED": str(hash_seed), "IMPORTED": imported}
    environment["HYPOTHESIS_PROFILE"] = "quick"
    command = [sys.executable, "-m", "pytest", "-c", os.devnull, "--rootdir", str(folder)]
    plugins = ["-p", "tests.conftest", "-p", "tests.draws", "-p", "no:cacheprovider"]
    done = run(
        [*command, *plugins, *options, "properties.py"],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return [line for line in done.stdout.splitlines() if line.startswith("drawn: ")]


def test_draws_depend_on_no_order_and_on_nothing_that_is_imported(tmp_path: Path) -> None:
    (tmp_path / "properties.py").write_text(dedent(PROPERTIES), encoding="utf-8")
    for name, text in MODULES.items():
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
    there = drawn(tmp_path, "one_of_ours", 1)
    assert len(there) == 6
    assert drawn(tmp_path, "another_of_ours", 2, "--backwards") == there
