"""A run that is killed, or that the disk fails, at any step: the next one finishes."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from framegen.cli import main
from framegen.reading.yamltree import Unusable
from framegen.writing import changes, write
from framegen.writing.workshop import NAME

from tests.documents import ROOT
from tests.writing.killed import EDITIONS, moments, patched, steps
from tests.writing.trees import LIBRARY, Snapshot, put, snapshot, without_workshop

if TYPE_CHECKING:
    from collections.abc import Callable

    from framegen.output import Output

SPOILT = f"{LIBRARY}/changed.py"
# An edit that is kept takes the steps of the next edition, and one more; the other slow ones differ
# from it in what is removed, not in how.
SLOW_SCENES = {"a fresh folder", "the next edition", "another name", "a lost manifest"}
SCENES = {
    "a fresh folder": ("", "first", False),
    "the next edition": ("first", "next", False),
    "another name": ("first", "renamed", False),
    "an edit that is kept": ("edited", "next", True),
    "a lost manifest": ("lost", "next", False),
}


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


@pytest.fixture(
    params=[
        pytest.param(name, marks=pytest.mark.slow if name in SLOW_SCENES else []) for name in SCENES
    ]
)
def scene(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Path, str, bool]:
    state, edition, force = SCENES[request.param]
    return prepared(tmp_path / "tree", state), edition, force


def finished(root: Path, edition: list[Output], *, force: bool) -> Snapshot:
    write(root, edition, all_of="spec", force=force)
    assert changes(root, edition) == []
    return snapshot(root)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="kills copies of its own process")
def test_a_run_that_is_killed_at_any_step_is_finished_by_the_next(
    scene: tuple[Path, str, bool], tmp_path: Path
) -> None:
    tree, edition, force = scene
    before = snapshot(tree)
    words = [str(tree), str(tmp_path), edition, *(["force"] if force else [])]
    done = subprocess.run(
        [sys.executable, "-m", "tests.writing.killed", *words],
        cwd=ROOT,
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 0, done.stderr
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


def _full() -> None:
    raise OSError(28, "No space left on device", "disk")


def _interrupted() -> None:
    raise KeyboardInterrupt


@pytest.mark.parametrize("fail", [_full, _interrupted])
def test_a_disk_that_fails_at_any_step_loses_nothing(
    scene: tuple[Path, str, bool], tmp_path: Path, fail: Callable[[], None]
) -> None:
    tree, edition, force = scene
    before = snapshot(tree)
    copy = tmp_path / "copy"
    taken = steps(tree, copy, edition, force=force)
    assert len(taken) > 10
    shutil.copytree(tree, copy)
    after = finished(copy, EDITIONS[edition], force=force)
    shutil.rmtree(copy)
    hints = set()
    for number, when in moments(taken):
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


def failure(root: Path, edition: list[Output], *, force: bool) -> BaseException | None:
    try:
        write(root, edition, all_of="spec", force=force)
    except (Unusable, KeyboardInterrupt) as error:
        return error
    return None


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
