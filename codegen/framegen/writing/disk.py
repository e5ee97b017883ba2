"""The steps that change the disk. Each succeeds or fails as a whole, except `write_file`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


def make_folder(folder: Path) -> None:
    """Make one folder, unless it is there."""
    folder.mkdir(exist_ok=True)


def write_file(file: Path, data: bytes, *, flush: bool = False) -> None:
    """Write a new file; with `flush`, wait until it has reached the disk."""
    with file.open("xb") as stream:
        stream.write(data)
        if flush:
            stream.flush()
            os.fsync(stream.fileno())


def move(old: Path, new: Path) -> None:
    """Rename a file within its file system, and replace what had that name."""
    old.replace(new)


def remove_file(file: Path) -> None:
    """Remove a file, unless it is gone."""
    file.unlink(missing_ok=True)


def remove_folder(folder: Path) -> None:
    """Remove an empty folder. Raises OSError where it is not empty."""
    folder.rmdir()
