"""The record of a folder that is copied as it is: whose it is, and the digest of each file.

It stands in that folder, and the manifest lists it alone: what it says of the others holds as long
as its own digest does. `sha256sum --check` reads it, too.
"""

from __future__ import annotations

from hashlib import sha256
from posixpath import basename, dirname
from typing import TYPE_CHECKING

from framegen import __version__
from framegen.output import banner

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

RECORD = "VENDORED.txt"
LICENSE = "LICENSE"


def record(files: Mapping[str, str]) -> str:
    """Return the record of files, by path below the folder."""
    licence = files.get(LICENSE, "").partition("\n")[0] or "see the package that it is from"
    head = (
        banner(""),
        "What libraries of all protocols have in common, copied here as it is.",
        f"framegen: {__version__}",
        f"licence: {licence}",
    )
    lines = (f"{sha256(files[path].encode()).hexdigest()}  {path}" for path in sorted(files))
    return "".join(f"{line}\n" for line in (*(f"# {line}" for line in head), *lines))


def recorded_folder(path: str) -> str:
    """Return the folder that a record is of; nothing for any other path."""
    return dirname(path) if basename(path) == RECORD else ""


def not_recorded(paths: Iterable[str]) -> list[str]:
    """Return the paths, but for those that a record among them speaks for."""
    known = [*paths]
    folders = tuple(f"{folder}/" for folder in map(recorded_folder, known) if folder)
    return [path for path in known if recorded_folder(path) or not path.startswith(folders)]
