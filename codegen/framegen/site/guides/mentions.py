"""Where the guides speak of a message: the sections that link to its page, or use it in code."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from framegen.site.guides.markdown import plain_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.site.guides.guide import Guide
    from framegen.targets.docs.message import MessagePage


@dataclass(frozen=True, slots=True)
class Mention:
    """One guide, and those of its sections that speak of a message; none for all of it."""

    guide: str
    page: str
    sections: list[Section]


@dataclass(slots=True)
class Section:
    """A section of a guide: its heading, what it links to, and its code."""

    anchor: str
    heading: str
    links: list[str] = field(default_factory=list)
    code: list[str] = field(default_factory=list)


class Mentions:
    """Where guides speak of messages; each guide is gone through once."""

    def __init__(self, guides: Iterable[Guide]) -> None:
        """Take the guides of a site."""
        self._guides = [(guide, [*_sections(guide)]) for guide in guides]

    def of(self, message: MessagePage, page: str) -> Iterator[Mention]:
        """Yield the guides that speak of a message, whose page has this path.

        Its name, and that of the client's method, count in code alone, and only in a guide whose
        code names the library: elsewhere they may be words like any other.
        """
        used = [rf"(?<![\w.]){re.escape(message.name)}\b"]
        if message.method:
            used.append(rf"\.{re.escape(message.method.partition('(')[0])}\(")
        library = re.compile(rf"\b{re.escape(message.model.spec.protocol.name)}\b")
        for guide, sections in self._guides:
            is_named = any(library.search(code) for section in sections for code in section.code)
            named = re.compile("|".join(used)) if is_named else None
            found = [
                section
                for section in sections
                if any(link.partition("#")[0].endswith(page) for link in section.links)
                or (named is not None and any(map(named.search, section.code)))
            ]
            if found:
                yield Mention(guide.title, guide.page, [each for each in found if each.anchor])


def _sections(guide: Guide) -> Iterator[Section]:
    """Yield the guide from heading to heading; what stands above the first one is its title's."""
    section = Section("", guide.title)
    heading = None
    for token in guide.tokens:
        if token.type == "heading_open" and token.tag != "h1":
            yield section
            heading = str(token.attrGet("id"))
        elif heading is not None and token.type == "inline":
            section, heading = Section(heading, plain_text(token)), None
        if token.type in ("fence", "code_block"):
            section.code.append(token.content)
        for child in token.children or []:
            if child.type == "code_inline":
                section.code.append(child.content)
            elif child.type == "link_open":
                section.links.append(str(child.attrGet("href") or ""))
    yield section
