"""A dataset that a process writes behind another that was killed; test_dask.py has two at once."""

import sys
from pathlib import Path

from tests.programs import ran
from tests.unit.runtime.tables.test_dataset import (
    archived,
    captures,
    rows_in,
    rows_of,
)

__all__ = ["captures"]


KILLED = """
import os, sys
from pathlib import Path
from busservo.tables import archive, scan
done = []
replace = Path.replace
def replaced(path, target):
    done.append(path)
    if len(done) == 12:
        os._exit(9)
    return replace(path, target)
Path.replace = replaced
for piece in scan(sys.argv[1], size=1000):
    archive(piece, sys.argv[2])
"""


def test_a_process_that_was_killed_is_replaced_by_another(captures: Path, tmp_path: Path) -> None:
    folder = tmp_path / "dataset"
    ran(sys.executable, "-c", KILLED, captures, folder, status=9)
    assert rows_in(folder) != rows_of(captures)
    reports = archived(captures, folder)
    assert {report.is_new for report in reports} == {True, False}
    assert rows_in(folder) == rows_of(captures)
    # Nor is anything left of the one that was killed.
    assert not [path for path in (folder / "_pieces").glob("*/*") if path.is_dir()]
