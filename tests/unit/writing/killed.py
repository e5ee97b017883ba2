"""Writes into copies of a tree, killed at each step in turn: a program of its own.

`python -m tests.unit.writing.killed TREE FOLDER NAME [force]` writes what `EDITIONS[NAME]` holds
into a copy of TREE for each step and each moment of it, in a child that kills itself there, and
prints the copy, the step and the moment.
"""

import os
import shutil
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from framegen.writing import disk, write

from tests.unit.writing.trees import NEWER, OLDER, RENAMED, schema

STEPS = ("make_folder", "write_file", "move", "remove_file", "remove_folder")
EDITIONS = {"first": [OLDER, schema()], "next": [NEWER, schema()], "renamed": [RENAMED, schema()]}


@contextmanager
def patched(at: int, when: str, stop: Callable[[], None]) -> Iterator[list[str]]:
    """Call `stop` at that step; yield the steps that are taken, as they come."""
    taken: list[str] = []

    def wrapped(name: str) -> Callable[..., None]:
        original = getattr(disk, name)

        def step(*arguments: Any, **options: Any) -> None:
            taken.append(name)
            if len(taken) != at:
                original(*arguments, **options)
                return
            if when == "halfway" and name == "write_file":
                file, data = arguments
                original(file, data[: len(data) // 2])
            elif when == "after":
                with suppress(OSError):  # such as of a folder that is not empty
                    original(*arguments, **options)
            stop()

        return step

    originals = {name: getattr(disk, name) for name in STEPS}
    for name in STEPS:
        setattr(disk, name, wrapped(name))
    try:
        yield taken
    finally:
        for name, original in originals.items():
            setattr(disk, name, original)


def _kill() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def steps(tree: Path, copy: Path, edition: str, *, force: bool) -> list[str]:
    """Return the steps that a run takes."""
    shutil.copytree(tree, copy, symlinks=True)
    with patched(0, "", lambda: None) as taken:
        write(copy, EDITIONS[edition], all_of="spec", force=force)
    shutil.rmtree(copy)
    return taken


def moments(steps: list[str]) -> Iterator[tuple[int, str]]:
    """Yield every state of the disk: after each step, and within each that can be cut short."""
    for number, name in enumerate(steps, 1):
        if name == "write_file":
            yield number, "halfway"
        yield number, "after"


def main() -> None:
    tree, folder, edition = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
    force = "force" in sys.argv
    # Whoever is killed has written all that he has written.
    setattr(os, "fsync", lambda _descriptor: None)  # noqa: B010
    for number, when in moments(steps(tree, folder / "copy", edition, force=force)):
        copy = folder / f"{when}-{number}"
        shutil.copytree(tree, copy, symlinks=True)
        child = os.fork()
        if child == 0:
            with patched(number, when, _kill):
                write(copy, EDITIONS[edition], all_of="spec", force=force)
            os._exit(0)
        _, status = os.waitpid(child, 0)
        assert os.WIFSIGNALED(status), (number, when)
        print(copy)


if __name__ == "__main__":
    main()
