"""Writes files of their author in the place of others: all are prepared before any is moved."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.reading.yamltree import Unusable
from framegen.writing import disk
from framegen.writing.places import Places
from framegen.writing.workshop import workshop
from framegen.writing.write import LOCK_TIMEOUT

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path


def replace(
    root: Path, files: Mapping[str, bytes], standing: Mapping[str, bytes | None]
) -> list[str]:
    """Write `files`, by path below `root`, in their order, and return the paths that changed.

    `standing` says what is expected at each path, None for nothing. Raises Unusable, with nothing
    written, where something else is there. A run that is killed leaves whole files, the first ones.
    """
    moved: list[str] = []
    try:
        with workshop(root, LOCK_TIMEOUT) as at:
            places = Places(root)
            for path, expected in standing.items():
                _expect(places, path, expected)
            wanted = {path: data for path, data in files.items() if standing[path] != data}
            staged = {
                path: at.stage(data, places.at(path), flush=True) for path, data in wanted.items()
            }
            for path, file in staged.items():
                place = places.at(path)
                places.make_folders_above(path)
                if standing[path] is not None:
                    shutil.copymode(place, file)
                disk.move(file, place)
                moved.append(path)
    except OSError as error:
        done = f"{', '.join(map(visible, moved))} was written" if moved else "nothing was written"
        raise Unusable(
            f"{visible(str(error.filename or root))} cannot be written: {error.strerror or error}",
            hint=f"{done}; mend that, and run this again",
        ) from None
    return moved


def _expect(places: Places, path: str, expected: bytes | None) -> None:
    found = places.look(path)
    if expected is None and found is not None:
        raise Unusable(f"{visible(path)} is there already", hint="nothing was written")
    if found is not None and found.kind:
        what = f"{visible(path)} is {found.kind}, and only a file is written"
        raise Unusable(what, hint="nothing was written")
    if expected is not None and (found is None or found.data != expected):
        what = f"{visible(path)} was changed meanwhile"
        raise Unusable(what, hint="nothing was written; run this again")
