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
        fixed = [*path.parts]
        found = [path]
        if not path.exists() and has_magic(str(path)):
            begin = next(at for at, part in enumerate(path.parts) if has_magic(part))
            fixed, pattern = fixed[:begin], str(Path(*fixed[begin:]))
            # What is not found is looked for as it was written, and missed.
            found = sorted(Path(*fixed).glob(pattern)) or found
        self.files = [file for each in found for file in _files(each, is_given=True)]
        folder = Path(*fixed)
        self.folder = folder if folder.is_dir() else folder.parent


def _files(path: Path, *, is_given: bool = False) -> Iterator[Path]:
    """Yield a file, or those in a folder; what cannot be looked at, too, so that it is reported."""
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
        is_linked_folder = each.is_symlink() and each.is_dir()
        if not each.name.startswith(".") and not is_linked_folder:
            yield from _files(each)


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
