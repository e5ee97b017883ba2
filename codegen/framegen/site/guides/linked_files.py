"""The files that guides link to, such as recordings: they are part of the site, as they are."""

from __future__ import annotations

import re
from pathlib import PurePosixPath
from typing import TYPE_CHECKING
from urllib.parse import quote, unquote

from framegen.console import visible
from framegen.project import FOLDER as SPECS
from framegen.reading.yamltree import Unusable
from framegen.site.guides.markdown import parse

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

# Below the root of the site.
FOLDER = "files"
_MAX_BYTES = 10_000_000
# Cheaper than to parse every guide for links that few of them have.
_MAY_LINK = re.compile(r"\.\./")


def linked_files(guides: Mapping[str, str], docs: Path) -> dict[str, bytes]:
    """Read the files of a project that guides link to, by path below the root of the site.

    Markdown and specs are no files: the first stays with the sources of the project, and the second
    has pages. Beside a file comes the Markdown that tells what it holds, `line.md` for `line.bin`.
    Raises Unusable for a file that is too large.
    """
    root = docs.parent
    found: dict[str, bytes] = {}
    for link in sorted({link for text in guides.values() for link in _links(text)}):
        for path in (link, link.with_suffix(".md")):
            if _is_there(root / path, root):
                found[f"{FOLDER}/{path}"] = _content(root / path)
    return found


def is_linked(path: str) -> bool:
    """Tell whether a file of the site is one that guides link to."""
    return path.startswith(f"{FOLDER}/")


def link_to(path: str) -> str:
    """Return the address of such a file from the folder of the guides, as they link to it."""
    return f"../{quote(path.removeprefix(f'{FOLDER}/'))}"


def _links(text: str) -> Iterator[PurePosixPath]:
    """Yield the links to files of the project that are not in the folder of the guides."""
    if not _MAY_LINK.search(text):
        return
    for token in parse(text):
        for each in token.children or ():
            path = unquote(str(each.attrGet("href") or "").partition("#")[0])
            steps = PurePosixPath(path).parts[1:]
            if path.startswith("../") and steps and _is_file(steps):
                yield PurePosixPath(*steps)


def _is_file(steps: Sequence[str]) -> bool:
    hidden = any(step.startswith(".") for step in steps)
    return not hidden and steps[0] != SPECS and not steps[-1].endswith(".md")


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
