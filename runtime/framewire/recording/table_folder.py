"""A folder of tables, a file each: it holds nothing else, and nothing half-written."""

from __future__ import annotations

import errno
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

UNFINISHED = ".part"
"""What the name of a file ends with while it is written."""


class TableFolder:
    """The files FOLDER/<Table> and a suffix, such as `.csv`, of the tables of these names."""

    def __init__(self, names: Sequence[str], folder: Path, suffix: str) -> None:
        self._names = names
        self._folder = folder
        self._suffix = suffix

    def unfinished(self, name: str) -> Path:
        """Return the file that a table is written to."""
        return self._folder / f"{name}{self._suffix}{UNFINISHED}"

    @contextmanager
    def replaced(self) -> Iterator[set[str]]:
        """Have new tables written, which then take the place of all others.

        The folder is made, or holds nothing but such files. Gives the set of the tables that are
        written, which the caller fills. Raises FileExistsError if it holds something else. Whatever
        goes wrong, what was there stays as it was.
        """
        is_new = not self._folder.exists()
        self._refuse_others()
        self._folder.mkdir(parents=True, exist_ok=True)
        written: set[str] = set()
        try:
            yield written
        except BaseException:
            for name in self._names:
                with suppress(OSError):
                    self.unfinished(name).unlink(missing_ok=True)
            if is_new:
                with suppress(OSError):
                    self._folder.rmdir()
            raise
        for name in self._names:
            path = self._folder / f"{name}{self._suffix}"
            if name in written:
                self.unfinished(name).replace(path)
            else:
                path.unlink(missing_ok=True)
                self.unfinished(name).unlink(missing_ok=True)

    def _refuse_others(self) -> None:
        """Raise FileExistsError if the folder holds what was not written here."""
        if not self._folder.exists():
            return
        ours = {f"{name}{self._suffix}{end}" for name in self._names for end in ("", UNFINISHED)}
        others = sorted({each.name for each in self._folder.iterdir()} - ours)
        if others:
            problem = f"it holds {others[0]!r}, which is no table of a capture: name another folder"
            raise FileExistsError(errno.EEXIST, problem, str(self._folder))
