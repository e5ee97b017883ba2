"""The Markdown of the guides: parsed once, by one parser with one setting."""

from __future__ import annotations

import re
from itertools import chain, count
from typing import TYPE_CHECKING

from markdown_it import MarkdownIt
from markdown_it.rules_inline import image, link

from framegen.reading.source import Span
from framegen.site.guides.forge import use_forge

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from markdown_it.rules_inline import StateInline
    from markdown_it.token import Token

    Rule = Callable[[StateInline, bool], bool]

# The anchors that every page has.
_TAKEN = frozenset({"announcement", "content", "search-box", "search-words", "sidebar"})
# Elements of HTML that lead somewhere, or show something.
_ELEMENT = re.compile(
    r"<(?:a|audio|embed|iframe|img|object|picture|source|video)(?:\s[^<>]*)?>", re.IGNORECASE
)
# What of the environment of a parser holds the HTML that it saw: the text around it, and its place.
_HTML = "html"


def parser() -> MarkdownIt:
    """Return the parser: no HTML passes it. A link and a picture know their place in their text."""
    made = MarkdownIt("commonmark", {"html": False}).enable("table")
    made.inline.ruler.at("link", _placed(link))
    made.inline.ruler.at("image", _placed(image))
    made.inline.ruler.at("html_inline", _note_html)
    return use_forge(made)


def _placed(rule: Rule) -> Rule:
    def noting(state: StateInline, silent: bool) -> bool:
        at, before = state.pos, len(state.tokens)
        found = rule(state, silent)
        if found and not silent:
            made = next(each for each in state.tokens[before:] if each.type in _PLACED)
            made.meta["at"] = at
        return found

    return noting


_PLACED = ("link_open", "image")


def _note_html(state: StateInline, silent: bool) -> bool:
    if not silent and (found := _ELEMENT.match(state.src, state.pos)):
        state.env.setdefault(_HTML, set()).add((state.src, state.pos, found[0]))
    return False


def parse(text: str) -> list[Token]:
    """Return the tokens of some Markdown."""
    return parser().parse(text)


def targets(text: str) -> Iterator[tuple[str, str, Span]]:
    """Yield what leads somewhere: `link_open`, `image` or `html`, what it leads to, and its place.

    Of HTML, which is shown as text, it is the element.
    """
    seen: dict[str, set[tuple[str, int, str]]] = {}
    lines = text.split("\n")
    for block in parser().parse(text, seen):
        for each in block.children or ():
            # What has no place is an address in angle brackets, which leads elsewhere.
            if "at" in each.meta:
                target = str(each.attrGet("src" if each.type == "image" else "href"))
                yield each.type, target, place_in(block, each.meta["at"], lines)
        for around, at, element in sorted(seen.get(_HTML, ())):
            if block.type == "inline" and around == block.content:
                yield "html", element, place_in(block, at, lines, len(element))


def place_in(block: Token, at: int, lines: Sequence[str], length: int = 1) -> Span:
    """Return where something stands that begins so far into the text of a block."""
    before = block.content[:at]
    number, here = before.count("\n"), before.rpartition("\n")[2]
    line = (block.map or [0])[0] + number
    # A block has its lines without what is in front of them, such as the mark of a list.
    start = lines[line].find(block.content.split("\n")[number])
    return Span(line + 1, start + len(here) + 1 if start >= 0 else 1, length)


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
