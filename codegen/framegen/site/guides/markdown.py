"""The Markdown of the guides: parsed once, by one parser with one setting."""

from __future__ import annotations

import re
from itertools import chain, count
from typing import TYPE_CHECKING

from markdown_it import MarkdownIt

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from markdown_it.token import Token

# The anchors that every page has.
_TAKEN = frozenset({"announcement", "content", "search-box", "search-words", "sidebar"})


def parser() -> MarkdownIt:
    """Return the parser: no HTML passes it."""
    return MarkdownIt("commonmark", {"html": False}).enable("table")


def parse(text: str) -> list[Token]:
    """Return the tokens of some Markdown."""
    return parser().parse(text)


def plain_text(inline: Token) -> str:
    """Return the words of a piece of text, without its marks."""
    words = (" " if "break" in each.type else each.content for each in inline.children or [])
    return "".join(words)


def slugs(headings: Iterable[str]) -> Iterator[str]:
    """Yield the anchors of the headings of a page, each its own: of two alike, `same`, `same-1`."""
    taken = set(_TAKEN)
    for heading in headings:
        first = slug(heading) or "section"
        anchors = chain([first], (f"{first}-{number}" for number in count(1)))
        anchor = next(each for each in anchors if each not in taken)
        taken.add(anchor)
        yield anchor


def slug(heading: str) -> str:
    """Return the anchor of a heading, as forges make it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
