"""The process that scripts of pages are asked in: whatever goes wrong in a program is seen."""

import pytest

from tests.in_turn import in_turn
from tests.unit.site.reference import NODE
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

# What fails at once, and what the process of the program would end with.
FAILURES = {
    "no script at all": "SyntaxError",
    "throw new Error('here');": "Error: here",
    "const answers = new Promise(() => {});": "a promise is never kept",
    "setTimeout(() => { throw new Error('later'); }, 5); const answers = 1;": "Error: later",
    "Promise.reject(new Error('lost')); const answers = 1;": "Error: lost",
}


@in_turn("program, words", FAILURES.items)
def test_a_failure_is_told_and_the_next_program_runs(program: str, words: str) -> None:
    with pytest.raises(AssertionError, match=words):
        run_script([], program, None)
    late = "const answers = new Promise((keep) => { setTimeout(() => keep(asked), 5); });"
    assert run_script([], late, {"wide": (1 << 60) + 1}) == {"wide": (1 << 60) + 1}
