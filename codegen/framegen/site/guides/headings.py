"""The headings of a page: their links, and the contents that are made of them."""

from __future__ import annotations

import re
from dataclasses import dataclass

from markupsafe import Markup

# All of this is HTML of our own: an attribute or a text with < or > in it was escaped before.
_HEADING = re.compile(r"<h([1-4])([^>]*)>(.*?)</h\1>", re.DOTALL)
_ID = re.compile(r' id="([^"]*)"')
_PERMALINK = re.compile(r'\s*<a class="permalink" href="#([^"]*)".*?</a>', re.DOTALL)
_TAG = re.compile(r"<[^>]*>")
# Contents that are longer leave the third level out.
_LONGEST = 30


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading below the title, with its anchor; `text` is HTML without elements."""

    level: int
    id: str
    text: Markup


def headings(html: str) -> list[Heading]:
    """Return the headings of the second and third level, or of the second where there are many."""
    found = [
        Heading(int(level), id_[1], _text(inside))
        for level, attributes, inside in _HEADING.findall(html)
        if level in "23" and (id_ := _ID.search(attributes))
    ]
    return found if len(found) <= _LONGEST else [each for each in found if each.level == 2]


def with_permalinks(html: str) -> Markup:
    """Put a link beside each heading that has an anchor, where its name does not include it.

    A link inside a heading, to what is around it, comes beside it as well.
    """
    return Markup(_HEADING.sub(_beside, html))  # noqa: S704 - it was HTML before


def _beside(match: re.Match[str]) -> str:
    level, attributes, inside = match.groups()
    anchor = _PERMALINK.search(inside) or _ID.search(attributes)
    if anchor is None:
        return match[0]
    return (
        f'<div class="heading"><h{level}{attributes}>{_PERMALINK.sub("", inside)}</h{level}>'
        f'<a class="permalink" href="#{anchor[1]}" aria-label="Link to {_text(inside)}">#</a></div>'
    )


def _text(html: str) -> Markup:
    text = " ".join(_TAG.sub("", _PERMALINK.sub("", html)).split())
    return Markup(text.replace('"', "&#34;"))  # noqa: S704 - it was HTML before
