"""`make release` sets one version everywhere, dates the changes and tags: `.ci/release.py`."""

import os
import re
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import pytest

from tests.documents import ROOT
from tests.programs import ran
from tests.repository import commit, git, start

GIT = shutil.which("git")
pytestmark = pytest.mark.skipif(GIT is None, reason="there is no git here")
FILES = (
    *(".ci/release.py", "CHANGELOG.md", "pyproject.toml", "codegen/pyproject.toml"),
    *("codegen/framegen/__init__.py", "runtime/framewire/edition.py"),
)


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository of what a release changes, with a version and a change."""
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    for name in FILES:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    (tmp_path / "CHANGELOG.md").write_text("# Changelog\n\n## [Unreleased]\n\n- More.\n")
    start(tmp_path)
    # The program that releases commits by itself.
    for key, value in (("user.name", "A"), ("user.email", "a@b"), ("core.autocrlf", "false")):
        git(tmp_path, "config", key, value)
    commit(tmp_path, {})
    return tmp_path


def release(folder: Path, *words: str) -> CompletedProcess[str]:
    return ran(sys.executable, folder / ".ci" / "release.py", *words, status=None)


def test_a_release_sets_one_version_and_tags_it(project: Path) -> None:
    done = release(project, "7.8.9")
    assert (done.returncode, done.stderr) == (0, "")
    changed = git(project, "show", "--format=%s", "v7.8.9", "--unified=0").splitlines()
    added = [line[1:] for line in changed if re.match(r"\+[^+]", line)]
    title, *versions = added
    assert re.fullmatch(r"## \[7\.8\.9\] - \d{4}-\d\d-\d\d", title)
    assert versions == [
        '__version__ = "7.8.9"',
        'version = "7.8.9"',
        'VERSION = "7.8.9"',
    ]
    assert "Release 7.8.9" in changed
    assert git(project, "status", "--porcelain") == ""
    assert (project / "CHANGELOG.md").read_text(encoding="utf-8") == (
        f"# Changelog\n\n## [Unreleased]\n\n{title}\n\n- More.\n"
    )


def test_a_check_changes_nothing(project: Path) -> None:
    before = git(project, "rev-parse", "HEAD")
    done = release(project, "--check", "7.8.9")
    assert (done.returncode, done.stderr) == (0, "")
    assert git(project, "status", "--porcelain") == git(project, "tag") == ""
    assert git(project, "rev-parse", "HEAD") == before


def no_changes(project: Path) -> None:
    (project / "CHANGELOG.md").write_text("# Changelog\n\n## [Unreleased]\n\n## [0.0.1] - then\n")
    commit(project, {})


def two_versions(project: Path) -> None:
    with (project / "pyproject.toml").open("a", encoding="utf-8") as file:
        file.write('version = "0.1.0"\n')
    commit(project, {})


@pytest.mark.parametrize(
    ("version", "spoil", "why"),
    [
        ("", None, "`` is no version: name three numbers, as in make release VERSION=0.2.0"),
        ("1.2", None, "`1.2` is no version"),
        ("v1.2.3", None, "`v1.2.3` is no version"),
        ("1.02.3", None, "`1.02.3` is no version"),
        ("0.0.9", None, "pyproject.toml: 0.0.9 is lower than 0."),
        ("7.8.9", lambda at: (at / "new").touch(), "commit or remove this first:\n?? new"),
        ("7.8.9", lambda at: git(at, "tag", "v7.8.9"), "there is a v7.8.9 already"),
        ("7.8.9", no_changes, "CHANGELOG.md: say under `## [Unreleased]` what changes"),
        ("7.8.9", two_versions, "pyproject.toml: the version stands there 2 times, not once"),
    ],
)
def test_what_can_be_no_release_is_refused(
    project: Path, version: str, spoil: Callable[[Path], object] | None, why: str
) -> None:
    if spoil is not None:
        spoil(project)
    before = git(project, "rev-parse", "HEAD") + git(project, "status", "--porcelain")
    done = release(project, version)
    assert done.returncode == 2
    assert done.stderr.startswith(f"no release: {why}")
    assert git(project, "rev-parse", "HEAD") + git(project, "status", "--porcelain") == before
