"""A run that the disk fails, or somebody ends, at a step: the next one finishes.

tests/world/test_killed.py has every step, and runs that are killed.
"""

import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from framegen.cli import main
from framegen.output import Output
from framegen.reading.yamltree import Unusable
from framegen.writing import changes, write
from framegen.writing.workshop import NAME

from tests.documents import ROOT
from tests.unit.writing.killed import EDITIONS, moments, patched, steps
from tests.unit.writing.trees import LIBRARY, Snapshot, put, snapshot, without_workshop

SPOILT = f"{LIBRARY}/changed.py"


def prepared(root: Path, state: str) -> Path:
    root.mkdir()
    if state:
        write(root, EDITIONS["first"])
    if state == "edited":
        put(root, SPOILT, "mine\n")
    if state == "lost":
        (root / "generated" / "kiln.manifest").unlink()
    return root


def wholly(found: Snapshot, *whole: Snapshot) -> bool:
    """Return whether each file is as in one of these states: nothing is half-written."""
    allowed = {data for state in whole for data in state.values()}
    return all(data in allowed for path, data in found.items() if not path.endswith(".manifest"))


def finished(root: Path, edition: list[Output], *, force: bool) -> Snapshot:
    write(root, edition, all_of="spec", force=force)
    assert changes(root, edition) == []
    return snapshot(root)


def _full() -> None:
    raise OSError(28, "No space left on device", "disk")


def _interrupted() -> None:
    raise KeyboardInterrupt


def failure(root: Path, edition: list[Output], *, force: bool) -> BaseException | None:
    try:
        write(root, edition, all_of="spec", force=force)
    except (Unusable, KeyboardInterrupt) as error:
        return error
    return None


def assert_nothing_is_lost(
    tree: Path, copy: Path, edition: str, *, force: bool, fail: Callable[[], None], each: int = 1
) -> None:
    """Let a run fail in a copy of a tree, at every so many moments, and run it again."""
    before = snapshot(tree)
    taken = steps(tree, copy, edition, force=force)
    assert len(taken) > 10
    shutil.copytree(tree, copy)
    after = finished(copy, EDITIONS[edition], force=force)
    shutil.rmtree(copy)
    hints = set()
    for number, when in [*moments(taken)][::each]:
        shutil.copytree(tree, copy)
        with patched(number, when, fail):
            error = failure(copy, EDITIONS[edition], force=force)
        found = snapshot(copy)
        if isinstance(error, Unusable):
            assert str(error) == "disk cannot be written: No space left on device"
            hints.add(error.hint.lstrip("0123456789").partition(" of ")[0])
        if getattr(error, "hint", "") == "nothing was changed":
            assert without_workshop(found) == before
        assert wholly(without_workshop(found), before, after)
        assert finished(copy, EDITIONS[edition], force=force) == after
        shutil.rmtree(copy)
    assert fail is _interrupted or hints == {"nothing was changed", ""}


@pytest.mark.parametrize("fail", [_full, _interrupted])
def test_a_disk_that_fails_at_a_step_loses_nothing(
    tmp_path: Path, fail: Callable[[], None]
) -> None:
    tree = prepared(tmp_path / "tree", "edited")
    assert_nothing_is_lost(tree, tmp_path / "copy", "next", force=True, fail=fail, each=9)


def test_an_edit_after_a_run_was_killed_is_an_edit(tmp_path: Path) -> None:
    """Although the manifest has both editions then, as after a merge."""
    tree = prepared(tmp_path / "tree", "first")
    taken = steps(tree, tmp_path / "copy", "next", force=False)
    with patched(len(taken) - 2, "after", _interrupted):
        assert failure(tree, EDITIONS["next"], force=False) is not None
    file = put(tree, SPOILT, (tree / SPOILT).read_text(encoding="utf-8") + "# mine\n")
    with pytest.raises(Unusable, match=f"edited by hand: {SPOILT}"):
        write(tree, EDITIONS["next"])
    assert file.read_text(encoding="utf-8").endswith("# mine\n")


def test_what_was_prepared_is_swept_when_the_disk_fails(tmp_path: Path) -> None:
    tree = prepared(tmp_path / "tree", "first")
    before = snapshot(tree)
    with patched(4, "halfway", _full), pytest.raises(Unusable):
        write(tree, EDITIONS["next"])
    assert snapshot(tree) == before


def test_what_a_killed_run_left_is_ignored_by_git_and_swept(tmp_path: Path) -> None:
    tree = prepared(tmp_path / "tree", "first")
    put(tree, f"{NAME}/new-7", "half")
    put(tree, f"{NAME}/lock", "1\n")
    before = without_workshop(snapshot(tree))
    # Even where there is nothing else to do.
    assert write(tree, EDITIONS["first"]).changes == []
    assert snapshot(tree) == before


@pytest.mark.skipif(sys.platform == "win32", reason="has no limit on the size of files")
def test_a_file_size_limit_is_reported_in_plain_words(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import resource  # noqa: PLC0415 - not on Windows

    (tmp_path / "spec").mkdir()
    spec = tmp_path / "spec" / "demo.yaml"
    shutil.copyfile(ROOT / "tests" / "specs" / "demo.yaml", spec)
    before = snapshot(tmp_path)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4_000, limits[1]))
    try:
        status = main(["generate", str(spec)])
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    out, err = capsys.readouterr()
    assert (status, out) == (2, "")
    assert err.startswith("framegen: error: ")
    assert err.endswith("cannot be written: File too large\n  hint: nothing was changed\n")
    assert snapshot(tmp_path) == before
