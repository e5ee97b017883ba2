"""The libraries of protocols that others made: linted and typed, as those in this repository."""

from pathlib import Path

import pytest

from tests.factories import compiled_file, library_files, write_files
from tests.protocols.specs import FILES
from tests.side_by_side import linted, type_checked
from tests.unit.skeleton.test_new_project import assert_its_tests_pass_with


def test_no_tool_finds_anything_in_a_library(tmp_path: Path) -> None:
    folder = tmp_path / "libraries"
    for file in FILES.values():
        made = library_files(compiled_file(file))
        # Beside a library that is a package of its own stands the file that says so.
        modules = {path.removeprefix("generated/"): made[path] for path in made}
        write_files({path: text for path, text in modules.items() if "/" in path}, folder)
    assert linted(folder) == {}
    assert type_checked(folder, tmp_path / "cache") == {}


@pytest.mark.parametrize("name", FILES)
def test_the_tests_of_a_new_project_hold_with_any_spec(name: str, tmp_path: Path) -> None:
    assert_its_tests_pass_with(FILES[name], tmp_path)
