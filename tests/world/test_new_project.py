"""The tests that come with a new project pass: its own, and those of its library with any spec."""

import re
from pathlib import Path

from tests.factories import ROOT
from tests.unit.commands.test_cli_framegen import process
from tests.unit.skeleton.test_new_project import assert_its_tests_pass_with, python, workplace

__all__ = ["workplace"]


def test_its_own_tests_pass(workplace: tuple[Path, str]) -> None:
    folder, _ = workplace
    done = python(folder / "kiln", "-m", "pytest", "-q", "-p", "no:cacheprovider")
    assert done.returncode == 0, done.stdout
    passed = re.search(r"(\d+) passed", done.stdout)
    assert passed is not None
    assert int(passed[1]) > 20


def test_a_python_without_docstrings_is_refused() -> None:
    script = "import sys; from framegen.cli import main; sys.exit(main(['schema']))"
    code, printed, errors = process("-OO", "-c", script)
    assert (code, printed) == (2, "")
    assert errors.startswith("framegen: error: Python was started with -OO, and has no ")


def test_the_tests_of_its_library_hold_for_any_other_spec(tmp_path: Path) -> None:
    """Among them one whose messages and fields have names that Python has taken."""
    assert_its_tests_pass_with(ROOT / "tests" / "specs" / "taken_names.yaml", tmp_path)
