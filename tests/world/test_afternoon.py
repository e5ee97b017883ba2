"""The guide to changes, followed in a repository of its own: every test passes when it is done."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests import documents
from tests.programs import ran
from tests.unit.project.test_house import our_files

ROOT = Path(__file__).parents[2]
GUIDE = "docs/changing-the-protocol.md"
# The packages that are installed lie elsewhere.
ELSEWHERE = "tests/unit/project/test_house.py::test_there_is_one_version"


def run(folder: Path, *words: str) -> str:
    """Run a module of the copy, and return what it prints."""
    folders = (folder / each for each in ("generated", "runtime", "codegen", "simulator"))
    path = os.pathsep.join(map(str, folders))
    variables = {"PYTHONPATH": path, "HYPOTHESIS_PROFILE": "quick"}
    return ran(
        *(sys.executable, "-m", *words),
        status=None,
        environment=variables,
        cwd=folder,
        timeout=None,
        capture_output=False,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    ).stdout


def copied(folder: Path) -> Path:
    """Copy what belongs to the project."""
    for file in our_files():
        copy = folder / file.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(file, copy)
    return folder


@pytest.mark.parametrize("section", ["Add a command", "Widen a field"])
def test_every_test_passes_where_the_guide_was_followed(section: str, tmp_path: Path) -> None:
    page = (ROOT / GUIDE).read_text(encoding="utf-8")
    begin = page.index(f"\n## {section}\n") + 1
    end = page.index("\n## ", begin)
    folder = copied(tmp_path)
    documents.committed(folder)
    documents.played(page[:end], folder)
    told = run(folder, "pytest", "-q", "-n", "2", f"--deselect={ELSEWHERE}")
    assert re.search(r"^\d+ passed[^,]*(, \d+ \w+)* in ", told, re.MULTILINE), told[-4000:]
    assert "failed" not in told.splitlines()[-1]
