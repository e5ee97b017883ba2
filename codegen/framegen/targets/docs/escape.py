"""Escaping of text from a spec for Markdown."""

from __future__ import annotations

import re
from urllib.parse import quote

from framegen.targets.docs.address import message_page

_SPECIAL = re.compile(r"([\\`*_\[\]|~^$])")
# What only means something at the start of a line: a heading, a list, a rule.
_LEADING = re.compile(r"([#+\-=]|[0-9]+(?=[.)](?:\s|$)))")
# Braces mean something to site generators, whatever stands in front of them.
_ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", "{": "&#123;", "}": "&#125;"})


class Safe(str):
    """Markdown that the generator wrote itself, or that has been escaped already."""

    __slots__ = ()


def markdown(value: object) -> str:
    """Escape `value` for Markdown: no mark-up, no HTML, no link, and all on one line."""
    if isinstance(value, Safe):
        return value
    text = str(value)
    # Most of it is names and numbers.
    if text.isascii() and text.isalpha():
        return text
    folded = " ".join(text.split())
    escaped = _SPECIAL.sub(r"\\\1", folded.translate(_ENTITIES))
    leading = _LEADING.match(escaped)
    if leading is not None:
        end = leading.end() if escaped[0].isdigit() else 0
        escaped = f"{escaped[:end]}\\{escaped[end:]}"
    # Forges make links of bare addresses; so written, they make none.
    return escaped.replace("://", "&#58;//").replace("www.", "www&#46;")


def code(value: object) -> Safe:
    """Put text into a code span, which nothing in the text can end."""
    text = " ".join(str(value).split()).replace("`", "'").replace("|", "\\|")
    return Safe(f"`{text}`" if text else "")


def verbatim(value: object) -> Safe:
    """Put text into a fenced block, which it must not be able to end."""
    return Safe(str(value).replace("```", "` ` `"))


def address(value: object) -> Safe:
    """Put text into the target of a link, which it must not be able to leave."""
    return Safe(quote(str(value), safe="#/"))


def named(name: str, root: str) -> Safe:
    """Make a message name lead to its page; the names of messages are plain words."""
    return Safe(f"[{markdown(name)}]({root}{quote(message_page(name))}.md)")


def paragraphs(text: str) -> list[str]:
    """Cut prose into its paragraphs, each on one line."""
    blocks = (" ".join(block.split()) for block in text.split("\n\n"))
    return [block for block in blocks if block]
