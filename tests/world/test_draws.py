"""All properties draw the same in any order, on any number of workers; each file by itself too."""

import os
import sys
from pathlib import Path
from subprocess import run

import pytest

from tests.unit.project.test_draws import drawn as drawn_of_kinds
from tests.unit.project.test_draws import folder

__all__ = ["folder"]

ROOT = Path(__file__).parents[2]
FILES = sorted(
    file.relative_to(ROOT).as_posix()
    for file in (ROOT / "tests").rglob("test_*.py")
    if "@given(" in file.read_text(encoding="utf-8") and Path(__file__).parent not in file.parents
)


def drawn(file: str, hash_seed: int, *options: str) -> list[str]:
    """Return the digest of each property of a file, and of all."""
    plugins = ["-p", "tests.draws", "-p", "no:cacheprovider", "-n", "0"]
    done = run(
        [sys.executable, "-m", "pytest", *plugins, "-m", "hypothesis", *options, file],
        cwd=ROOT,
        env={**os.environ, "PYTHONHASHSEED": str(hash_seed), "HYPOTHESIS_PROFILE": "ci"},
        capture_output=True,
        text=True,
        check=False,
    )
    # A file may only have properties that are examples of some.
    assert done.returncode in {0, pytest.ExitCode.NO_TESTS_COLLECTED}, done.stdout + done.stderr
    return [line for line in done.stdout.splitlines() if line.startswith("drawn: ")]


@pytest.mark.parametrize("file", FILES)
def test_properties_draw_the_same_in_any_order(file: str) -> None:
    there = drawn(file, 1)
    assert there
    assert drawn(file, 2, "--shuffled", "7") == there


def test_workers_draw_what_one_process_does(folder: Path) -> None:
    there = drawn_of_kinds(folder, "-n 0 --backwards", "one_of_ours", 1)
    for options in ("-n 2", "-n 3 --dist loadfile", "-n 4 --dist worksteal"):
        shuffled = f"{options} --shuffled {len(options)}"
        assert drawn_of_kinds(folder, shuffled, "another_of_ours", 2) == there, options
