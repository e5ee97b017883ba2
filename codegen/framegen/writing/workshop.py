"""The folder in the root in which a run prepares its files, and which locks out other runs.

It ignores itself in git, and is removed at the end; the next run removes what a killed run left.
"""

from __future__ import annotations

import os
import sys
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.reading.yamltree import Unusable
from framegen.writing import disk

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import errno
    import fcntl

NAME = ".framegen"
_LOCK, _IGNORE, _STAGED = "lock", ".gitignore", "new-"
# Windows locks bytes, and nobody can read those: so one behind all that is written.
_LOCKED_BYTE = 1 << 20
_PAUSE = 0.05


class Workshop:
    """A place to prepare files, each on the file system that it will lie on."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self._folders: dict[int, Path] = {}
        self._nearest: dict[Path, Path] = {}
        self._number = 0

    def stage(self, data: bytes, place: Path, *, flush: bool) -> Path:
        """Write a file that is to be moved to `place`, whose folder need not be there yet."""
        folder = self._folder(place)
        self._number += 1
        staged = folder / f"{_STAGED}{self._number}"
        disk.write_file(staged, data, flush=flush)
        return staged

    def _folder(self, place: Path) -> Path:
        """Return the folder on the file system that a place will lie on."""
        if place.parent not in self._nearest:
            above = next(folder for folder in place.parents if folder.is_dir())
            device = above.stat().st_dev
            if device not in self._folders:
                self._folders[device] = _opened(self._top(above, device))
            self._nearest[place.parent] = self._folders[device]
        return self._nearest[place.parent]

    def _top(self, above: Path, device: int) -> Path:
        """Return the root, or the mount point below it."""
        while above != self.root and above.parent.stat().st_dev == device:
            above = above.parent
        return above

    def close(self) -> None:
        """Remove the folder."""
        for folder in self._folders.values():
            _sweep(folder)


def is_left_over(root: Path) -> bool:
    """Tell whether a workshop is in a root, of a run that is under way or was killed."""
    return os.path.lexists(root / NAME)


@contextmanager
def workshop(root: Path, timeout: float) -> Iterator[Workshop]:
    """Lock the root for one run. Raises Unusable where another run goes on for long."""
    missing = [folder for folder in (root, *root.parents) if not folder.exists()]
    for folder in reversed(missing):
        disk.make_folder(folder)
    lock = _locked(root / NAME, timeout)
    made = Workshop(root)
    try:
        _sweep_staged(root / NAME)
        yield made
    finally:
        with suppress(OSError):
            made.close()
        _unlock(lock, root / NAME)


def _made(folder: Path) -> None:
    if folder.is_symlink():
        raise Unusable(
            f"{visible(str(folder))} is a link, and a run prepares there what it writes",
            hint="remove it; nothing was changed",
        )
    disk.make_folder(folder)


def _opened(parent: Path) -> Path:
    folder = parent / NAME
    _made(folder)
    _sweep_staged(folder)
    ignore = folder / _IGNORE
    if not ignore.exists():
        ignore.write_bytes(b"*\n")
    return folder


def _sweep_staged(folder: Path) -> None:
    for file in folder.glob(f"{_STAGED}*"):
        disk.remove_file(file)


def _sweep(folder: Path) -> None:
    """Remove a folder, unless another run has just come into it."""
    _sweep_staged(folder)
    if not (folder / _LOCK).exists():
        with suppress(OSError):
            (folder / _IGNORE).unlink(missing_ok=True)
            folder.rmdir()


def _locked(folder: Path, timeout: float) -> int:
    """Return a descriptor that holds the lock, which the system releases when the process ends."""
    until = time.monotonic() + timeout
    while (lock := _attempt(folder)) is None:
        if time.monotonic() > until:
            raise Unusable(
                f"another run of framegen{_holder(folder)} is writing in "
                f"{visible(str(folder.parent))}",
                hint="wait until it has ended, and run this again; nothing was changed",
            )
        time.sleep(_PAUSE)
    os.truncate(lock, 0)
    os.write(lock, f"{os.getpid()}\n".encode())
    return lock


def _attempt(folder: Path) -> int | None:
    try:
        _made(folder)
        lock = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT, 0o666)
    except (FileNotFoundError, FileExistsError):
        if folder.is_file():
            raise
        return None  # the run before has just removed the folder
    try:
        held = _hold(lock) and os.path.samestat(os.fstat(lock), os.stat(folder / _LOCK))  # noqa: PTH116
    except FileNotFoundError:  # the run before has just removed what was locked here
        held = False
    except BaseException:
        os.close(lock)
        raise
    if held:
        return lock
    os.close(lock)
    return None


if sys.platform == "win32":

    def _hold(lock: int) -> bool:
        """Try to lock, and tell whether it succeeded."""
        os.lseek(lock, _LOCKED_BYTE, os.SEEK_SET)
        try:
            msvcrt.locking(lock, msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        finally:
            os.lseek(lock, 0, os.SEEK_SET)
        return True

else:

    def _hold(lock: int) -> bool:
        """Try to lock, and tell whether it succeeded."""
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            return error.errno in (errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP)
        return True


def _unlock(lock: int, folder: Path) -> None:
    """Remove the lock's file while it is held: a waiting run sees that it is another one."""
    try:
        with suppress(OSError):
            (folder / _IGNORE).unlink(missing_ok=True)
            # Windows removes no file that is open, nor one that somebody waits for.
            if sys.platform == "win32":
                os.close(lock)
            (folder / _LOCK).unlink(missing_ok=True)
            folder.rmdir()
    finally:
        if sys.platform != "win32":
            os.close(lock)


def _holder(folder: Path) -> str:
    try:
        number = (folder / _LOCK).read_text(encoding="ascii").strip()
    except (OSError, ValueError):
        return ""
    return f" (process {number})" if number.isdecimal() else ""
