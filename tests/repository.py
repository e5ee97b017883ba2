"""A git repository in a folder of its own, which knows nothing of who runs the tests."""

import os
from pathlib import Path
from shutil import which

from tests.factories import write_files
from tests.programs import ran

# Neither the machine nor a hook that runs the tests has a say.
ALONE = {
    "GIT_CONFIG_GLOBAL": os.devnull,
    "GIT_CONFIG_NOSYSTEM": "1",
    "GIT_AUTHOR_NAME": "A",
    "GIT_AUTHOR_EMAIL": "a@example.org",
    "GIT_COMMITTER_NAME": "A",
    "GIT_COMMITTER_EMAIL": "a@example.org",
}
OF_A_HOOK = ("GIT_DIR", "GIT_INDEX_FILE", "GIT_WORK_TREE", "GIT_PREFIX")


def git(folder: Path, *words: str, status: int = 0) -> str:
    """Run git in a folder, and return what it prints."""
    inherited = {name: value for name, value in os.environ.items() if name not in OF_A_HOOK}
    program = which("git") or "git"
    return ran(program, *words, status=status, cwd=folder, env=inherited | ALONE).stdout.strip()


def start(folder: Path) -> None:
    """Make a repository of a folder, without a commit."""
    folder.mkdir(parents=True, exist_ok=True)
    git(folder, "init", "--quiet", "--initial-branch=main", "--template=")


def commit(
    folder: Path, files: dict[str, str], tag: str = "", message: str = "What it holds"
) -> None:
    """Write files below the folder, commit all there is, and tag it."""
    write_files(files, folder)
    git(folder, "add", "--all")
    git(folder, "commit", "--quiet", "--allow-empty", "--message", message)
    if tag:
        git(folder, "tag", tag)
