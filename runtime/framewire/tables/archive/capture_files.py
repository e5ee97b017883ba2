"""The files of captures, found by names, patterns and folders, and what each is called."""

from __future__ import annotations

import os
from glob import has_magic
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

MANIFESTS = "_pieces"
"""The folder of a dataset that tells which pieces are done."""


def capture_files(paths: Sequence[str | os.PathLike[str]]) -> dict[str, Path]:
    """Return the files by their names below the folder that holds all, in a stable order."""
    roots = [_Root(Path(path).absolute()) for path in paths]
    above = _common([root.folder for root in roots])
    files = dict.fromkeys(file for root in roots for file in root.files)
    return {_name(file, above): file for file in files}


class _Root:
    """What one path means: the files, and the folder below which they are named."""

    def __init__(self, path: Path) -> None:
        folder, pattern = path, ""
        if not path.exists() and has_magic(str(path)):
            begin = next(at for at, part in enumerate(path.parts) if has_magic(part))
            folder, pattern = Path(*path.parts[:begin]), str(Path(*path.parts[begin:]))
        self.folder = folder if folder.is_dir() else folder.parent
        within = self.folder.resolve()
        matching = sorted(folder.glob(pattern)) if pattern else []
        # What is not found is looked for as it was written, and missed.
        found = [each for each in matching if not _leads_out(each, within)] or [path]
        self.files = [file for each in found for file in _files(each, within, is_given=True)]


def _files(path: Path, within: Path, *, is_given: bool = False) -> Iterator[Path]:
    """Yield a file, or those in a folder; what cannot be looked at, too, so that it is reported.

    A link that leads out of `within` is neither.
    """
    try:
        if not path.is_dir():
            # Of what is found, neither pipes nor devices are read.
            if is_given or path.is_file() or not path.exists():
                yield path
            return
        inside = sorted(path.iterdir())
    except OSError:
        yield path
        return
    if any(each.name == MANIFESTS for each in inside):
        return
    for each in inside:
        if not each.name.startswith(".") and not _is_skipped_link(each, within):
            yield from _files(each, within)


def _is_skipped_link(path: Path, within: Path) -> bool:
    """Tell whether this is a link to a folder, of which there may be no end, or leads out."""
    return path.is_symlink() and (_is_folder(path) or _leads_out(path, within))


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError:
        return False


def _leads_out(path: Path, within: Path) -> bool:
    """Tell whether links on the way to what is there lead out of a folder."""
    try:
        return path.exists() and not path.resolve().is_relative_to(within)
    except OSError:
        return False


def _common(folders: Sequence[Path]) -> Path | None:
    """Return the folder that holds all; None if there is none, as on different drives."""
    try:
        return Path(os.path.commonpath(folders))
    except ValueError:
        return None


def _name(file: Path, above: Path | None) -> str:
    """Return the name of a capture."""
    if above is None:
        return file.as_posix()
    return file.name if file == above else file.relative_to(above).as_posix()
