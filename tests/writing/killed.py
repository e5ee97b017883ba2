"""Writes into copies of a tree, and is killed at each step in turn: a program of its own.

`python -m tests.writing.killed TREE FOLDER NAME [force]` writes what `EDITIONS[NAME]` holds into a
copy of TREE for each step and each moment of it, in a child that kills itself there, and prints the
copy, the step and the moment.
"""

from __future__ import annotations

import os
import shutil
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from framegen.writing import disk, write

from tests.writing.trees import AFTER, BEFORE, RENAMED, schema

if TYPE_CHECKING:
    from collections.abc import Callable

STEPS = ("make_folder", "write_file", "move", "remove_file", "remove_folder")
EDITIONS = {"first": [BEFORE, schema()], "next": [AFTER, schema()], "renamed": [RENAMED, schema()]}


def patch(at: int, when: str, stop: Callable[[], None], patched: Callable[..., None]) -> list[str]:
    """Have `stop` called at that step; gives the steps that are taken, as they come."""
    taken: list[str] = []

    def wrapped(name: str) -> Callable[..., None]:
        original = getattr(disk, name)

        def step(*arguments: Any) -> None:
            taken.append(name)
            if len(taken) != at:
                original(*arguments)
                return
            if when == "halfway" and name == "write_file":
                file, data = arguments
                original(file, data[: len(data) // 2])
            elif when == "after":
                original(*arguments)
            stop()

        return step

    for name in STEPS:
        patched(disk, name, wrapped(name))
    return taken


def _kill() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def _write(root: Path, edition: str, *, force: bool) -> None:
    write(root, EDITIONS[edition], all_of="spec", force=force)


def main() -> None:
    tree, folder, edition = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
    force = "force" in sys.argv
    # Whoever is killed has written all that he has written.
    os.fsync = lambda _descriptor: None
    for when in ("before", "halfway", "after"):
        step = 0
        while True:
            step += 1
            copy = folder / f"{when}-{step}"
            shutil.copytree(tree, copy, symlinks=True)
            child = os.fork()
            if child == 0:
                patch(step, when, _kill, setattr)
                _write(copy, edition, force=force)
                os._exit(0)
            _, status = os.waitpid(child, 0)
            if not os.WIFSIGNALED(status):
                shutil.rmtree(copy)
                assert os.WEXITSTATUS(status) == 0
                break
            print(copy)


if __name__ == "__main__":
    main()
