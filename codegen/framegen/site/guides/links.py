"""What guides link to and show: as it is written, where that is, and what it leads to."""

from __future__ import annotations

import posixpath
import re
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Literal
from urllib.parse import unquote

from framegen.site.guides.markdown import targets

if TYPE_CHECKING:
    from framegen.reading.source import Span

# The folder of the guides, by which other files of the project know it.
FOLDER = "docs"
_KINDS: dict[str, Kind] = {"link_open": "link", "image": "picture", "html": "html"}
_ELSEWHERE = re.compile(r"//|[a-z][a-z0-9+.-]*:", re.IGNORECASE)

Kind = Literal["link", "picture", "html"]


@dataclass(frozen=True, slots=True)
class Link:
    """A link or a picture of a guide, or an element of HTML, with what it leads to or shows."""

    kind: Kind
    target: str
    span: Span


@cache
def links_of(text: str) -> tuple[Link, ...]:
    """Return what some Markdown links to and shows, in order."""
    found = (Link(_KINDS[kind], target, span) for kind, target, span in targets(text))
    return tuple(sorted(found, key=lambda link: link.span))


def is_elsewhere(target: str) -> bool:
    """Tell whether a link leads to another site, or to what no site is."""
    return _ELSEWHERE.match(target) is not None


def name_of(path: str, guide: str) -> str:
    """Return what a guide links to by this path, as it is known from the folder of the guides.

    `first.md` lies there, `../CHANGELOG.md` in the project around it.
    """
    file = posixpath.normpath(posixpath.join(FOLDER, posixpath.dirname(guide), unquote(path)))
    below = f"{FOLDER}/"
    return file.removeprefix(below) if file.startswith(below) else f"../{file}"
