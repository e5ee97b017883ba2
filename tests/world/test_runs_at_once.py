"""Several runs of `framegen generate` in one folder at once."""

import subprocess
import sys
from pathlib import Path

from framegen.writing import changes
from framegen.writing.workshop import NAME

from tests.documents import ROOT
from tests.unit.writing.conftest import no_power_fails
from tests.unit.writing.test_places import root
from tests.unit.writing.trees import AFTER, BEFORE, RENAMED, schema

__all__ = ["no_power_fails", "root"]


RUN = """
import sys
from pathlib import Path
from framegen.writing import write
from tests.unit.writing.killed import EDITIONS

for _ in range(10):
    for name in sys.argv[2:]:
        write(Path(sys.argv[1]), EDITIONS[name], all_of="spec", timeout=600)
"""


def test_runs_at_once_take_turns(root: Path) -> None:
    """Whatever each of them wants: the last one has it, and nobody blames anybody."""
    orders = [("first", "next", "renamed"), ("next", "renamed", "first"), ("renamed", "renamed")]
    running = [
        subprocess.Popen(
            [sys.executable, "-c", RUN, str(root), *order],
            cwd=ROOT,
            stderr=subprocess.PIPE,
            encoding="utf-8",
        )
        for order in orders
    ]
    assert [process.communicate()[1] for process in running] == ["", "", ""]
    assert [process.returncode for process in running] == [0, 0, 0]
    assert not (root / NAME).exists()
    states = [[AFTER, schema()], [BEFORE, schema()], [RENAMED, schema()]]
    assert [changes(root, state) for state in states].count([]) == 1
