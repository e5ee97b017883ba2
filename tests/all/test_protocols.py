"""The libraries of protocols that others made: linted and typed, as those in this repository."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.contract.libraries import linted, type_checked
from tests.factories import compiled_file, library_files, write_files
from tests.protocols.specs import FILES

if TYPE_CHECKING:
    from pathlib import Path


def test_no_tool_finds_anything_in_a_library(tmp_path: Path) -> None:
    folder = tmp_path / "libraries"
    for file in FILES.values():
        made = library_files(compiled_file(file))
        # Beside a library that is a package of its own stands the file that says so.
        modules = {path.removeprefix("generated/"): made[path] for path in made}
        write_files({path: text for path, text in modules.items() if "/" in path}, folder)
    assert linted(folder) == {}
    assert type_checked(folder, tmp_path / "cache") == {}
