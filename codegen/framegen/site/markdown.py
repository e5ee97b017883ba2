"""The Markdown of the guides: parsed once, by one parser with one setting."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from markdown_it import MarkdownIt

if TYPE_CHECKING:
    from markdown_it.token import Token


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


def slug(heading: str) -> str:
    """Return the anchor of a heading, as forges make it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
