"""The plan of the site: what the README of the guides lists, in its order and by its headings."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING
from urllib.parse import unquote

from framegen.site.guides.links import is_elsewhere, name_of
from framegen.site.guides.markdown import parse, place_in, plain_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from markdown_it.token import Token

    from framegen.reading.source import Span

README = "README.md"
# What a list above all headings is called.
_FIRST = "Guides"
_REFERENCE = re.compile(r"reference/([^/]+)/README\.md")


@dataclass(frozen=True, slots=True)
class Entry:
    """A guide, or a reference, and what the README says of it; `span` is where its link stands."""

    link: str
    label: str
    about: str
    span: Span

    @property
    def protocol(self) -> str:
        """The protocol whose reference it is, if it is one."""
        found = _REFERENCE.fullmatch(self.link)
        return found[1] if found else ""


@dataclass(frozen=True, slots=True)
class Section:
    """A heading of the README, what stands below it, and the list that follows."""

    title: str
    about: str
    entries: tuple[Entry, ...]


@dataclass(slots=True)
class Part:
    """The lines of a README from `start` to `end`: those below one heading, or above all of them.

    Where there is a list of guides, `left` are the lines that are neither in it nor in `about`.
    """

    title: str
    start: int
    end: int = 0
    about: str = ""
    entries: list[Entry] = field(default_factory=list)
    left: list[int] = field(default_factory=list)

    @property
    def is_listing(self) -> bool:
        """Whether there is a list of guides: one that leads elsewhere is text like any other."""
        links = (entry.link for entry in self.entries)
        return any(link.endswith(".md") and not is_elsewhere(link) for link in links)


@dataclass(frozen=True)
class Plan:
    """What a README says: a title, an introduction in Markdown, and sections with lists."""

    readme: str

    @cached_property
    def _tokens(self) -> list[Token]:
        return parse(self.readme)

    @cached_property
    def _lines(self) -> list[str]:
        return self.readme.splitlines(keepends=True)

    @cached_property
    def title(self) -> str:
        """The first heading; without any, what all guides are called."""
        titles = (plain_text(after) for _, after in self._headings("h1"))
        return next(titles, _FIRST)

    @cached_property
    def introduction(self) -> str:
        """What stands above the first section, but for the title, as it is written."""
        end = self.parts[0].end
        start, after = next((before.map or (0, 0) for before, _ in self._headings("h1")), (0, 0))
        shown = [*self._lines[:start], *self._lines[after:end]] if start < end else []
        return "".join(shown).strip()

    @cached_property
    def sections(self) -> list[Section]:
        """The sections that have a list of links."""
        listing = (part for part in self.parts if part.is_listing)
        return [Section(each.title, each.about, (*each.entries,)) for each in listing]

    @cached_property
    def rest(self) -> str:
        """The sections that have no list of links, in Markdown."""
        others = [part for part in self.parts[1:] if not part.is_listing]
        return "".join("".join(self._lines[part.start : part.end]) for part in others)

    @cached_property
    def parts(self) -> list[Part]:
        """All of it, from heading to heading; the first part is what stands above them."""
        found = [Part(_FIRST, 0)]
        depth = 0
        for before, token in zip([None, *self._tokens], self._tokens, strict=False):
            depth += {"list_item_open": 1, "list_item_close": -1}.get(token.type, 0)
            start = (token.map or [0])[0]
            if token.type == "heading_open" and token.tag == "h2":
                found[-1].end = start
                found.append(Part("", start))
            elif before is not None and before.type == "heading_open" and before.tag == "h2":
                found[-1].title = plain_text(token)
            elif before is not None and token.type in ("inline", "fence", "code_block"):
                self._take(found[-1], token, before, in_item=depth > 0)
        found[-1].end = len(self._lines)
        # The introduction has them.
        found[0].about, found[0].left = "", []
        return found

    def _take(self, part: Part, token: Token, before: Token, *, in_item: bool) -> None:
        """Take a piece of text into a part."""
        words = token.type == "inline" and before.type == "paragraph_open"
        found = [*_entry(token, self._lines)] if words and in_item else []
        part.entries += found
        if words and not in_item and not part.entries:
            part.about = f"{part.about} {plain_text(token)}".strip()
        elif not found:
            part.left.append((token.map or [0])[0] + 1)

    def _headings(self, tag: str) -> Iterator[tuple[Token, Token]]:
        for before, token in pairwise(self._tokens):
            if before.type == "heading_open" and before.tag == tag:
                yield before, token


def _entry(item: Token, lines: Sequence[str]) -> Iterator[Entry]:
    """Yield the entry that a line of a list is, if it begins with a link."""
    children = item.children or []
    if children and children[0].type == "link_open":
        end = next(index for index, each in enumerate(children) if each.type == "link_close")
        label = "".join(each.content for each in children[1:end])
        rest = "".join(
            " " if "break" in each.type else each.content for each in children[end + 1 :]
        )
        target = str(children[0].attrGet("href"))
        link = unquote(target) if is_elsewhere(target) else name_of(target, README)
        place = place_in(item, children[0].meta.get("at", 0), lines)
        yield Entry(link, label, _sentence(rest, children[end + 1 :]), place)


def _sentence(text: str, tokens: Sequence[Token]) -> str:
    """Return what follows a link and a colon as a sentence, but leave code as it is."""
    text = text.lstrip(": ").strip()
    begins = next((each for each in tokens if each.content.strip(": ")), None)
    if begins is None or begins.type == "code_inline":
        return text
    return text[:1].upper() + text[1:]
