"""Odd places for output: links, pipes, folders, read-only folders; two runs at once."""

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from framegen.reading.yamltree import Unusable
from framegen.writing import changes, survey, write
from framegen.writing.workshop import NAME, workshop

from tests.unit.writing.trees import AFTER, BEFORE, LIBRARY, put, snapshot

CHANGED = f"{LIBRARY}/changed.py"


@pytest.fixture
def root(tmp_path: Path) -> Path:
    made = tmp_path / "root"
    write(made, [BEFORE])
    return made


def _link(at: Path, to: Path, *, folder: bool = False) -> None:
    try:
        at.symlink_to(to, target_is_directory=folder)
    except OSError:  # pragma: no cover - Windows without the privilege
        pytest.skip("this system makes no symbolic links")


@pytest.mark.parametrize("name", ["generated", LIBRARY, "docs", f"{LIBRARY}/old"])
def test_a_link_that_leads_out_is_refused_and_named(root: Path, tmp_path: Path, name: str) -> None:
    away = tmp_path / "away"
    (root / name).rename(away)
    _link(root / name, away, folder=True)
    before = snapshot(tmp_path)
    for force in (False, True):
        with pytest.raises(Unusable) as caught:
            write(root, [AFTER], force=force)
        assert str(caught.value) == f"{name} is a link that leads to {away}, out of {root}"
        assert "--out FOLDER" in caught.value.hint
        with pytest.raises(Unusable):
            changes(root, [AFTER])
    assert snapshot(tmp_path) == before


def test_a_link_of_a_file_that_leads_out_is_refused(root: Path, tmp_path: Path) -> None:
    away = put(tmp_path, "away.py", "precious\n")
    (root / CHANGED).unlink()
    _link(root / CHANGED, away)
    with pytest.raises(Unusable, match="is a link that leads to"):
        write(root, [AFTER], force=True)
    with pytest.raises(Unusable, match="is a link that leads to"):
        changes(root, [AFTER])
    assert away.read_bytes() == b"precious\n"


def test_a_workshop_that_leads_out_is_refused(root: Path, tmp_path: Path) -> None:
    (tmp_path / "away").mkdir()
    put(tmp_path, "away/new-1", "precious\n")
    _link(root / NAME, tmp_path / "away", folder=True)
    with pytest.raises(Unusable, match=f"{NAME} is a link"):
        write(root, [AFTER])
    assert (tmp_path / "away" / "new-1").exists()


def test_a_link_within_the_root_is_a_folder_like_any_other(root: Path) -> None:
    (root / LIBRARY).rename(root / "real")
    _link(root / LIBRARY, root / "real", folder=True)
    assert changes(root, [BEFORE]) == []
    write(root, [AFTER])
    assert (root / LIBRARY).is_symlink()
    assert (root / "real" / "changed.py").read_text() == AFTER.files[CHANGED]
    assert not (root / "real" / "gone.py").exists()


def test_a_root_behind_a_link_is_written_like_any_other(root: Path, tmp_path: Path) -> None:
    _link(tmp_path / "link", root, folder=True)
    assert changes(tmp_path / "link", [BEFORE]) == []
    write(tmp_path / "link", [AFTER])
    assert changes(root, [AFTER]) == []


def test_a_link_in_place_of_a_file_is_somebodys(root: Path) -> None:
    other = root / "other.py"
    (root / CHANGED).rename(other)
    _link(root / CHANGED, other)
    # Unless the file that it leads to is as it is wanted.
    assert changes(root, [BEFORE]) == []
    other.write_bytes(b"mine\n")
    assert [(c.path, c.why) for c in changes(root, [BEFORE])] == [(CHANGED, "foreign")]
    done = write(root, [BEFORE], force=True)
    assert (root / done.kept[CHANGED]).is_symlink()
    assert other.read_bytes() == b"mine\n"
    assert changes(root, [BEFORE]) == []


def _folder(place: Path) -> None:
    place.mkdir()
    (place / "inner.py").write_bytes(b"mine\n")


def _pipe(place: Path) -> None:
    if not hasattr(os, "mkfifo"):
        pytest.skip("this system has no named pipes")
    os.mkfifo(place)


@pytest.mark.parametrize("make", [_folder, _pipe])
@pytest.mark.parametrize("path", [CHANGED, "generated/kiln.manifest"])
def test_what_is_no_file_is_left_alone(root: Path, path: str, make: Callable[[Path], None]) -> None:
    """And never opened: a pipe that nobody writes to would keep the run waiting."""
    (root / path).unlink()
    make(root / path)
    kind = (root / path).lstat().st_mode
    found = [(change.path, change.why) for change in changes(root, [BEFORE])]
    assert (path, "foreign") in found
    with pytest.raises(Unusable, match=f"foreign: {path}"):
        write(root, [BEFORE])
    done = write(root, [BEFORE], force=True)
    assert (root / done.kept[path]).lstat().st_mode == kind
    assert changes(root, [BEFORE]) == []


def test_an_orphan_that_is_no_file_any_more_is_left(root: Path) -> None:
    (root / LIBRARY / "gone.py").unlink()
    (root / LIBRARY / "gone.py").mkdir()
    write(root, [AFTER])
    assert (root / LIBRARY / "gone.py").is_dir()
    assert changes(root, [AFTER]) == []


@pytest.fixture
def read_only(root: Path) -> Iterator[Path]:
    """Return a root whose library cannot be written, even by a superuser."""
    folder = root / LIBRARY
    here = Path.cwd()
    # Relative, since the folders above may be closed to anybody else.
    os.chdir(root)
    superuser = hasattr(os, "geteuid") and os.geteuid() == 0
    try:
        for path in (root, *root.rglob("*")):
            path.chmod(0o777 if path.is_dir() else 0o644)
        folder.chmod(0o555)
        if superuser:
            os.seteuid(65534)
        yield Path()
    finally:
        if superuser:
            os.seteuid(0)
        folder.chmod(0o755)
        os.chdir(here)


@pytest.mark.skipif(os.name == "nt", reason="folders are not read-only on Windows")
def test_a_read_only_folder_is_reported_and_left_alone(read_only: Path) -> None:
    before = snapshot(read_only / LIBRARY)
    with pytest.raises(Unusable, match="cannot be written: Permission denied") as caught:
        write(read_only, [AFTER])
    assert "run this again to finish" in caught.value.hint
    assert snapshot(read_only / LIBRARY) == before


@pytest.mark.skipif(os.name == "nt", reason="folders are not read-only on Windows")
def test_nothing_is_written_where_nothing_differs(read_only: Path) -> None:
    """Not even to keep other runs out."""
    assert write(read_only, [BEFORE]).changes == []


def test_a_second_run_waits_and_says_who_is_at_work(root: Path) -> None:
    before = snapshot(root)
    with workshop(root, 0), pytest.raises(Unusable) as caught:
        write(root, [AFTER], timeout=0.2)
    message = f"another run of framegen (process {os.getpid()}) is writing in {root}"
    assert str(caught.value) == message
    assert caught.value.hint == "wait until it has ended, and run this again; nothing was changed"
    assert snapshot(root) == before


def test_a_survey_does_not_wait_for_the_lock(root: Path) -> None:
    with workshop(root, 0):
        before = snapshot(root)
        assert survey(root, [AFTER]).changes != []
        assert snapshot(root) == before


def test_a_stale_lock_keeps_nobody_out(root: Path) -> None:
    """Of a run that was killed, or on a system that has lost its power."""
    put(root, f"{NAME}/lock", "1\n")
    write(root, [AFTER], timeout=0)
    assert not (root / NAME).exists()
