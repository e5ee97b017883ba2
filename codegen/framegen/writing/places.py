"""The places of output: what stands there, and that no path leads out of the root."""

from __future__ import annotations

import os
import stat
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.reading.yamltree import Unusable
from framegen.writing import disk

if TYPE_CHECKING:
    from collections.abc import Iterator

# What Python and the desktop leave behind in any folder, and nobody wrote.
_LITTER = frozenset(["__pycache__", ".DS_Store", "Thumbs.db"])


@dataclass(frozen=True, slots=True)
class Standing:
    """What stands at a path: a file with its bytes, or the kind of anything else."""

    data: bytes
    kind: str = ""


class Places:
    """The paths below a root. Raises Unusable where a link leads one of them out of it."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self._real = Path(os.path.realpath(root))
        self._looked_at = {""}

    def at(self, path: str) -> Path:
        """Return the place of a path, all folders above it being folders below the root."""
        self._look_above(path)
        place = self.root / path
        if place.is_symlink():
            self._stay(path)
        return place

    def _look_above(self, path: str) -> None:
        """Look at each folder above a path, once."""
        if path.rpartition("/")[0] in self._looked_at:
            return
        for folder in map(str, reversed(PurePosixPath(path).parents[:-1])):
            if folder not in self._looked_at:
                self._look_at(folder)
                self._looked_at.add(folder)

    def _look_at(self, folder: str) -> None:
        place = self.root / folder
        self._stay(folder)
        try:
            mode = place.stat().st_mode
        except (FileNotFoundError, NotADirectoryError):
            return
        if not stat.S_ISDIR(mode):
            raise Unusable(
                f"{visible(folder)} is no folder, but output goes there",
                hint="move it elsewhere; nothing was changed",
            )

    def _stay(self, path: str) -> None:
        real = Path(os.path.realpath(self.root / path))
        if not real.is_relative_to(self._real):
            raise Unusable(
                f"{visible(path)} is a link that leads to {visible(str(real))}, "
                f"out of {visible(str(self.root))}",
                hint="remove it, or name where output is to go: --out FOLDER; nothing was changed",
            )

    def look(self, path: str) -> Standing | None:
        """Return what stands at a path; None for nothing. Raises Unusable if it cannot be read."""
        self._look_above(path)
        place = self.root / path
        try:
            kind = _kind(place.lstat().st_mode)
            # A link stands for its file, as long as there is nothing to write.
            if kind == "a link":
                self._stay(path)
            regular = not kind or (kind == "a link" and place.is_file())
            return Standing(place.read_bytes() if regular else b"", kind)
        except FileNotFoundError:
            return None
        except OSError as error:
            reason = error.strerror or str(error)
            raise Unusable(f"{visible(str(place))} cannot be read: {reason}") from None

    def make_folders_above(self, path: str) -> None:
        """Make the folders above a path that are not there yet."""
        if not (self.root / path).parent.is_dir():
            for folder in reversed(PurePosixPath(path).parents[:-1]):
                disk.make_folder(self.root / folder)

    def listed(self, folder: str, pattern: str) -> list[str]:
        """Return the files of a folder, not of those below, whose names match."""
        place = self.at(f"{folder}/x").parent
        return sorted(str(PurePosixPath(folder, file.name)) for file in place.glob(pattern))

    def files_below(self, folder: str) -> Iterator[str]:
        """Yield the files of a folder and those below it, through no link, in any order."""
        top = self.at(f"{folder}/x").parent
        for above, folders, names in os.walk(top):
            folders[:] = sorted(set(folders) - _LITTER)
            inner = Path(above).relative_to(self.root)
            start = f"{inner.as_posix()}/" if inner.parts else ""
            yield from (f"{start}{name}" for name in names if name not in _LITTER)


def _kind(mode: int) -> str:
    """Name the kind of what is no plain file."""
    if stat.S_ISREG(mode):
        return ""
    if stat.S_ISDIR(mode):
        return "a folder"
    if stat.S_ISLNK(mode):
        return "a link"
    return "no file"
