"""Writes files that belong to their author from then on: all that are missing, or none."""

from __future__ import annotations

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

# Of many files that stand in the way, as many are named.
_NAMED = 10


def create(root: Path, files: Mapping[str, str]) -> list[str]:
    """Write what is missing of `files`, by path below `root`, and return the paths written.

    What stands there with the same text is left: so a run that was killed is finished by the next.
    Raises Unusable, with nothing written, where something else stands there.
    """
    try:
        missing = _missing(root, files)
        if not missing:
            return []
        with workshop(root, LOCK_TIMEOUT) as at:
            missing = _missing(root, files)
            places = Places(root)
            staged = {
                path: at.stage(files[path].encode(), places.at(path), flush=False)
                for path in missing
            }
            for path, file in staged.items():
                place = places.at(path)
                places.make_folders_above(path)
                disk.move(file, place)
    except OSError as error:
        raise Unusable(
            f"{visible(str(error.filename or root))} cannot be written: {error.strerror or error}",
            hint="mend that, and run this again",
        ) from None
    return missing


def _missing(root: Path, files: Mapping[str, str]) -> list[str]:
    """Return the paths at which nothing stands. Raises Unusable where something else does."""
    places = Places(root)
    missing, others = [], []
    for path, text in files.items():
        standing = places.look(path)
        if standing is None:
            missing.append(path)
        elif standing.kind or standing.data.replace(b"\r\n", b"\n") != text.encode():
            others.append(path)
    if others:
        shown = ", ".join(visible(path) for path in others[:_NAMED])
        more = f" and {len(others) - _NAMED} more" if len(others) > _NAMED else ""
        raise Unusable(
            f"{visible(str(root))} has files already that would be written: {shown}{more}",
            hint="name another folder: --into FOLDER; nothing was written",
        )
    return missing
