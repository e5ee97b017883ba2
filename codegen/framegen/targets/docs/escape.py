"""Escaping of text from a spec for HTML, for Markdown, and for JSON in a script."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from markupsafe import Markup, escape

from framegen.targets.docs.address import message_page

if TYPE_CHECKING:
    from collections.abc import Mapping

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


def linked(text: str, addresses: Mapping[str, str], root: str) -> Markup:
    """Return `text` as HTML, in which every message name is a link to its page."""
    result = Markup()
    for word in re.split(r"(\w+)", text):
        address = addresses.get(word)
        if address is None:
            result += escape(word)
        else:
            result += Markup('<a href="{}{}">{}</a>').format(root, address, word)
    return result


def anchor(text: str) -> str:
    """Return `text` as part of an anchor: what is no letter, digit or dot becomes a dash."""
    return re.sub(r"[^\w.]+", "-", text)


def script_json(value: Any) -> Markup:
    """Return `value` as JSON inside a script element, which nothing in it can close."""
    text = json.dumps(value, ensure_ascii=True, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)  # noqa: S704 - nothing is left in it that HTML would read


def paragraphs(text: str) -> list[str]:
    """Cut prose into its paragraphs, each on one line."""
    blocks = (" ".join(block.split()) for block in text.split("\n\n"))
    return [block for block in blocks if block]
