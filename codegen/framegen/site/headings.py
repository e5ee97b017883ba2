"""The headings of a page: their links, and the contents that are made of them."""

from __future__ import annotations

import re
from dataclasses import dataclass

from markupsafe import Markup

# All of this is HTML of our own: an attribute or a text with < or > in it was escaped before.
_HEADING = re.compile(r'<h([234])((?: [^>]*)? id="([^"]*)"[^>]*)>(.*?)</h\1>', re.DOTALL)
_PERMALINK = re.compile(r'\s*<a class="permalink".*?</a>', re.DOTALL)
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
        Heading(int(level), id_, _text(inside))
        for level, _, id_, inside in _HEADING.findall(html)
        if level in "23"
    ]
    return found if len(found) <= _LONGEST else [each for each in found if each.level == 2]


def with_permalinks(html: str) -> Markup:
    """Put a link beside each heading that has an anchor, where its name does not include it."""

    def beside(match: re.Match[str]) -> str:
        level, attributes, id_, inside = match.groups()
        inside = _PERMALINK.sub("", inside)
        text = _text(inside)
        return (
            f'<div class="heading"><h{level}{attributes}>{inside}</h{level}>'
            f'<a class="permalink" href="#{id_}" aria-label="Link to {text}">#</a></div>'
        )

    return Markup(_HEADING.sub(beside, html))  # noqa: S704 - it was HTML before


def _text(html: str) -> Markup:
    text = " ".join(_TAG.sub("", _PERMALINK.sub("", html)).split())
    return Markup(text.replace('"', "&#34;"))  # noqa: S704 - it was HTML before
