"""Writes the output so that a run that is killed is finished by the next one.

All files are prepared first, then the manifests list the old and the new digests, then file after
file is replaced, and at last the manifests list the new ones alone. A file that matches a manifest,
old or new, is framegen's own.
"""

from __future__ import annotations

import errno
from dataclasses import dataclass, field
from glob import escape
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.reading.yamltree import Unusable
from framegen.writing import disk
from framegen.writing.change import Change, describe
from framegen.writing.kept import kept_place
from framegen.writing.manifest import as_data
from framegen.writing.places import Places
from framegen.writing.survey import Survey, survey
from framegen.writing.workshop import is_left_over, workshop

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from framegen.output import Output
    from framegen.writing.workshop import Workshop

# A folder that is not empty, not there, a link, or in use by somebody stays, and is no failure.
_STAYS = (
    errno.ENOTEMPTY,
    errno.EEXIST,
    errno.ENOENT,
    errno.ENOTDIR,
    errno.EACCES,
    errno.EPERM,
    errno.EBUSY,
)
# How long a run waits for another one to end, in seconds.
LOCK_TIMEOUT = 10.0


@dataclass(slots=True)
class Written:
    """The changes made; `kept` says where files of others are now that were in the way."""

    changes: list[Change] = field(default_factory=list)
    kept: dict[str, str] = field(default_factory=dict)
    strangers: list[str] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)


def write(
    root: Path,
    outputs: Sequence[Output],
    *,
    all_of: str | None = None,
    shared: bool = False,
    force: bool = False,
    timeout: float = LOCK_TIMEOUT,
) -> Written:
    """Write the output, and return what was changed. `all_of` and `shared` are as for `survey`.

    Raises Unusable, with nothing changed, where that would replace or remove what is not
    framegen's own; with `force` such files are kept beside. Where the disk fails in the middle,
    another run finishes.
    """
    found = survey(root, outputs, all_of=all_of, shared=shared, force=force)
    if not found.changes and not is_left_over(root):
        return Written(strangers=found.strangers, notices=found.notices)
    writer: _Writer | None = None
    try:
        with workshop(root, timeout) as at:
            found = survey(root, outputs, all_of=all_of, shared=shared, force=force)
            if not force:
                _expect_no_obstacle(found)
            writer = _Writer(Places(root), at, found)
            writer.write()
    except OSError as error:
        raise Unusable(
            f"{visible(str(error.filename or root))} cannot be written: {error.strerror or error}",
            hint="nothing was changed" if writer is None else writer.progress(),
        ) from None
    return writer.done


def _expect_no_obstacle(found: Survey) -> None:
    obstacles = [change for change in found.changes if not change.ours]
    if obstacles:
        raise Unusable(
            f"somebody's work would be lost, so nothing was written\n{describe(obstacles)}",
            hint="move it elsewhere or undo it; "
            "or use --force, which keeps it beside its place, as NAME.mine",
        )


class _Writer:
    """One run, from preparations to the last manifest."""

    def __init__(self, places: Places, at: Workshop, found: Survey) -> None:
        self.done = Written(strangers=found.strangers, notices=found.notices)
        self._begun = False
        self._places = places
        self._at = at
        self._found = found
        self._files = [change for change in found.changes if change.path not in found.manifests]
        self._manifests = [change for change in found.changes if change.path in found.manifests]

    def write(self) -> None:
        staged = {
            change.path: self._stage(change.path, change.new)
            for change in self._found.changes
            if change.new is not None
        }
        plans = self._found.plans if self._files else {}
        planned = {path: self._stage(path, text) for path, text in plans.items()}
        # Once a plan stands, its end has to be written, even if it is what was there before.
        for path in plans.keys() & self._found.finals.keys() - staged.keys():
            staged[path] = self._stage(path, self._found.finals[path])
        for change in self._manifests:
            if not change.ours:
                self._keep(change.path)
        for path, plan in planned.items():
            self._put(path, plan)
        self._change_files(staged)
        self._remove_empty_folders()
        self._conclude(staged)

    def _change_files(self, staged: dict[str, Path]) -> None:
        # What goes, goes first: where capitals do not tell names apart, its place may be wanted.
        for change in sorted(self._files, key=lambda change: change.new is not None):
            if not change.ours:
                self._keep(change.path)
            elif change.new is None:
                self._remove(change.path)
            if change.new is not None:
                self._put(change.path, staged[change.path])
            self.done.changes.append(change)

    def _conclude(self, staged: dict[str, Path]) -> None:
        for path in sorted(self._found.finals.keys() & staged.keys()):
            self._put(path, staged[path])
        for change in self._manifests:
            if change.new is None:
                self._remove(change.path)
            self.done.changes.append(change)
        self.done.changes.sort(key=lambda change: change.path)

    def progress(self) -> str:
        """Say how far the run got, and what is to be done."""
        if not self._begun:
            return "nothing was changed"
        done, all_of_them = len(self.done.changes), len(self._found.changes)
        return f"{done} of {all_of_them} changes were made; run this again to finish"

    def _stage(self, path: str, content: str | bytes) -> Path:
        flush = path in self._found.manifests
        return self._at.stage(as_data(content), self._places.at(path), flush=flush)

    def _remove(self, path: str) -> None:
        self._begun = True
        disk.remove_file(self._places.at(path))

    def _keep(self, path: str) -> None:
        place = self._places.at(path)
        free = kept_place(place)
        self._begun = True
        disk.move(place, free)
        self.done.kept[path] = path.removesuffix(place.name) + free.name

    def _put(self, path: str, staged: Path) -> None:
        self._begun = True
        place = self._places.at(path)
        self._places.make_folders_above(path)
        disk.move(staged, place)

    def _remove_empty_folders(self) -> None:
        """Remove what Python made of removed files, and empty folders."""
        folders = set()
        for path in sorted(self._found.left):
            place = self._places.at(path)
            if place.suffix == ".py" and not place.exists():
                cache = place.parent / "__pycache__"
                for file in cache.glob(f"{escape(place.stem)}.*.pyc"):
                    disk.remove_file(file)
                folders.add(cache)
            folders |= {self._places.root / it for it in PurePosixPath(path).parents[:-1]}
        # Each before the one that it lies in.
        for folder in sorted(folders, reverse=True):
            _remove_if_empty(folder)


def _remove_if_empty(folder: Path) -> None:
    try:
        disk.remove_folder(folder)
    except OSError as error:
        if error.errno not in _STAYS:
            raise
