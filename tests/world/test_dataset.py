"""A dataset that several processes write: at once, and one behind another that was killed."""

import multiprocessing
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from busservo.tables import archive, scan

from tests.programs import ran
from tests.unit.runtime.tables.test_dataset import (
    SIZE,
    archived,
    captures,
    files_in,
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


def test_two_processes_make_the_same_files_as_one(captures: Path, tmp_path: Path) -> None:
    archived(captures, tmp_path / "by one")
    pieces = scan(captures, size=SIZE)
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=spawn) as pool:
        reports = list(pool.map(archive, pieces, [tmp_path / "by two"] * len(pieces)))
    assert [report.piece for report in reports] == pieces
    by_one, by_two = tmp_path / "by one", tmp_path / "by two"
    assert files_in(by_two) == files_in(by_one)
    for name in files_in(by_one):
        assert (by_two / name).read_bytes() == (by_one / name).read_bytes()


def test_a_process_that_was_killed_is_replaced_by_another(captures: Path, tmp_path: Path) -> None:
    folder = tmp_path / "dataset"
    ran(sys.executable, "-c", KILLED, captures, folder, status=9)
    assert rows_in(folder) != rows_of(captures)
    reports = archived(captures, folder)
    assert {report.is_new for report in reports} == {True, False}
    assert rows_in(folder) == rows_of(captures)
    # Nor is anything left of the one that was killed.
    assert not [path for path in (folder / "_pieces").glob("*/*") if path.is_dir()]
