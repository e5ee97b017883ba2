"""All properties draw the same in either order, those of each file in processes of their own."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from subprocess import run

import pytest

ROOT = Path(__file__).parents[2]
FILES = sorted(
    file.relative_to(ROOT).as_posix()
    for file in (ROOT / "tests").rglob("test_*.py")
    if "@given(" in file.read_text(encoding="utf-8") and Path(__file__).parent not in file.parents
)


def drawn(file: str, hash_seed: int, *options: str) -> list[str]:
    """Return the digest of each property of a file."""
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
def test_properties_draw_the_same_in_either_order(file: str) -> None:
    assert drawn(file, 1) == drawn(file, 2, "--backwards")
