"""The plan of the site: what the README of the guides lists, in its order and by its headings."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING
from urllib.parse import unquote

from framegen.site.guides.markdown import parse, plain_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from markdown_it.token import Token

README = "README.md"
# What a list above all headings is called.
_FIRST = "Guides"
_REFERENCE = re.compile(r"reference/([^/]+)/README\.md")


@dataclass(frozen=True, slots=True)
class Entry:
    """A guide, or a reference, and what the README says of it."""

    link: str
    label: str
    about: str

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


@dataclass(frozen=True)
class Plan:
    """What a README says: a title, an introduction in Markdown, and sections with lists."""

    readme: str

    @cached_property
    def _tokens(self) -> list[Token]:
        return parse(self.readme)

    @cached_property
    def title(self) -> str:
        """The first heading."""
        return next(plain_text(after) for tag, after in self._headings() if tag == "h1")

    @cached_property
    def introduction(self) -> str:
        """What stands between the title and the first section, as it is written."""
        body = self.readme.partition("\n")[2]
        return re.split(r"^## ", body, maxsplit=1, flags=re.MULTILINE)[0].strip()

    @cached_property
    def sections(self) -> list[Section]:
        """The sections that have a list of links."""
        found: list[Section] = []
        title, about, entries = _FIRST, "", list[Entry]()
        named = False
        in_item = False
        for before, token in zip([None, *self._tokens], self._tokens, strict=False):
            if before is not None and before.type == "heading_open" and before.tag == "h2":
                found += [Section(title, about, tuple(entries))] if entries else []
                title, about, entries = plain_text(token), "", []
                named = True
            in_item = token.type != "list_item_close" and (
                in_item or token.type == "list_item_open"
            )
            if token.type == "inline" and before is not None and before.type == "paragraph_open":
                if in_item:
                    entries += _entry(token)
                elif named and not entries:
                    about = f"{about} {plain_text(token)}".strip()
        return [*found, Section(title, about, tuple(entries))] if entries else found

    @cached_property
    def rest(self) -> str:
        """The sections that have no list of links, in Markdown."""
        listed = {section.title for section in self.sections}
        found = re.split(r"^(?=## )", self.readme, flags=re.MULTILINE)[1:]
        titles = [each.partition("\n")[0].removeprefix("## ").strip() for each in found]
        return "".join(
            text for title, text in zip(titles, found, strict=True) if title not in listed
        )

    def _headings(self) -> Iterator[tuple[str, Token]]:
        for before, token in zip(self._tokens, self._tokens[1:], strict=False):
            if before.type == "heading_open":
                yield before.tag, token


def _entry(item: Token) -> Iterator[Entry]:
    """Yield the entry that a line of a list is, if it begins with a link."""
    children = item.children or []
    if children and children[0].type == "link_open":
        end = next(index for index, each in enumerate(children) if each.type == "link_close")
        label = "".join(each.content for each in children[1:end])
        rest = "".join(
            " " if "break" in each.type else each.content for each in children[end + 1 :]
        )
        link = unquote(str(children[0].attrGet("href")))
        yield Entry(link, label, _sentence(rest, children[end + 1 :]))


def _sentence(text: str, tokens: Sequence[Token]) -> str:
    """Return what follows a link and a colon as a sentence, but leave code as it is."""
    text = text.lstrip(": ").strip()
    begins = next((each for each in tokens if each.content.strip(": ")), None)
    if begins is None or begins.type == "code_inline":
        return text
    return text[:1].upper() + text[1:]
