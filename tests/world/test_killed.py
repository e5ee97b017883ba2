"""Runs of the writer that are killed, that the disk fails at every step, or that are at once."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from framegen.writing import changes
from framegen.writing.workshop import NAME

from tests.documents import ROOT
from tests.programs import ran
from tests.unit.writing.conftest import no_power_fails
from tests.unit.writing.killed import EDITIONS
from tests.unit.writing.test_killed import (
    _full,
    _interrupted,
    assert_nothing_is_lost,
    finished,
    prepared,
    wholly,
)
from tests.unit.writing.test_places import root
from tests.unit.writing.trees import snapshot, without_workshop

__all__ = ["no_power_fails", "root"]

SCENES = {
    "a fresh folder": ("", "first", False),
    "the next edition": ("first", "next", False),
    "another name": ("first", "renamed", False),
    "an edit that is kept": ("edited", "next", True),
    "a lost manifest": ("lost", "next", False),
}


@pytest.fixture(params=SCENES)
def scene(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Path, str, bool]:
    state, edition, force = SCENES[request.param]
    return prepared(tmp_path / "tree", state), edition, force


@pytest.mark.skipif(not hasattr(os, "fork"), reason="kills copies of its own process")
def test_a_run_that_is_killed_at_any_step_is_finished_by_the_next(
    scene: tuple[Path, str, bool], tmp_path: Path
) -> None:
    tree, edition, force = scene
    before = snapshot(tree)
    words = [str(tree), str(tmp_path), edition, *(["force"] if force else [])]
    done = ran(sys.executable, "-m", "tests.unit.writing.killed", *words, cwd=ROOT)
    copies = [Path(line) for line in done.stdout.splitlines()]
    after = finished(tree, EDITIONS[edition], force=force)
    assert len(copies) > 3 * len(EDITIONS[edition][0].files)
    for copy in copies:
        found = without_workshop(snapshot(copy))
        assert wholly(found, before, after), copy.name
        # What somebody wrote is there at every moment, and never in the way of the next run.
        assert not force or b"mine\n" in found.values(), copy.name
        assert finished(copy, EDITIONS[edition], force=force) == after, copy.name
        shutil.rmtree(copy)


@pytest.mark.parametrize("fail", [_full, _interrupted])
def test_a_disk_that_fails_at_any_step_loses_nothing(
    scene: tuple[Path, str, bool], tmp_path: Path, fail: Callable[[], None]
) -> None:
    tree, edition, force = scene
    assert_nothing_is_lost(tree, tmp_path / "copy", edition, force=force, fail=fail)


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
    assert [changes(root, state) for state in EDITIONS.values()].count([]) == 1
