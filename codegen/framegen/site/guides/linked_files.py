"""The files that guides link to or show, such as recordings: they are part of the site as is."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.project import FOLDER as SPECS
from framegen.reading.yamltree import Unusable
from framegen.site.guides.links import FOLDER as GUIDES
from framegen.site.guides.links import is_elsewhere, links_of, name_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

# Below the root of the site.
FOLDER = "files"
# Those that are shown lie in a folder of their own, whether a guide shows them or not.
PICTURES = "images"
_MAX_BYTES = 10_000_000


def pictures(docs: Path) -> dict[str, bytes]:
    """Read the folder of pictures, by path below the folder of the guides."""
    files = sorted(docs.joinpath(PICTURES).rglob("*"))
    named = {file.relative_to(docs).as_posix(): file for file in files if file.is_file()}
    return {name: file.read_bytes() for name, file in named.items() if not _is_hidden(name)}


def linked_files(guides: Mapping[str, str], docs: Path) -> dict[str, bytes]:
    """Read the files of a project that guides link to or show, by path below the root of the site.

    Markdown and specs are no files: the first is a page or stays with the sources of the project,
    and the second has pages. Beside a file comes the Markdown that tells what it holds, `line.md`
    for `line.bin`. Raises Unusable for a file that is too large.
    """
    root = docs.parent
    found: dict[str, bytes] = {}
    for link in sorted({link for guide, text in guides.items() for link in _files(guide, text)}):
        # Among the guides, Markdown is a page of its own.
        is_below = link.parts[0] == GUIDES
        for path in (link,) if is_below else (link, link.with_suffix(".md")):
            file = docs / path.relative_to(GUIDES) if is_below else root / path
            if _is_there(file, root):
                found[f"{FOLDER}/{path}"] = _content(file)
    return found


def is_linked(path: str) -> bool:
    """Tell whether a file of the site is one that guides link to."""
    return path.startswith(f"{FOLDER}/")


def link_to(path: str) -> str:
    """Return the name of such a file from the folder of the guides, as they link to it."""
    below = path.removeprefix(f"{FOLDER}/")
    return below.removeprefix(f"{GUIDES}/") if below.startswith(f"{GUIDES}/") else f"../{below}"


def _files(guide: str, text: str) -> Iterator[PurePosixPath]:
    """Yield what a guide links to or shows of the project, but for pages and pictures."""
    for link in links_of(text):
        path = link.target.partition("#")[0]
        if link.kind != "html" and path and not is_elsewhere(path):
            name = name_of(path, guide)
            below = name.removeprefix("../") if name.startswith("../") else f"{GUIDES}/{name}"
            if _is_file(PurePosixPath(below)):
                yield PurePosixPath(below)


def _is_file(path: PurePosixPath) -> bool:
    shown = path.parts[:1] == (SPECS,) or path.parts[:2] == (GUIDES, PICTURES)
    return not (shown or path.suffix == ".md" or _is_hidden(path.as_posix()))


def _is_hidden(path: str) -> bool:
    return any(step.startswith(".") for step in path.split("/"))


def _is_there(file: Path, root: Path) -> bool:
    """Tell whether there is such a file, and it lies in the project, whatever links say."""
    try:
        real = file.resolve()
        return real.is_file() and real.is_relative_to(root.resolve())
    except (OSError, ValueError):
        return False


def _content(file: Path) -> bytes:
    try:
        if file.stat().st_size <= _MAX_BYTES:
            return file.read_bytes()
    except OSError as error:
        raise Unusable(f"{visible(file.as_posix())} cannot be read: {error.strerror}") from None
    raise Unusable(
        f"{visible(file.as_posix())} is too large for the site: a file that a guide links to has "
        f"at most {_MAX_BYTES // 1_000_000} MB",
        hint="link to a smaller one, or write its path as code instead of as a link",
    )
