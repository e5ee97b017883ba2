"""What can be found in the guides: each of them, its sections, and the rows of its glossary."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from framegen.site.guides.markdown import plain_text
from framegen.site.search.entry import Entry

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from markdown_it.token import Token

    from framegen.site.guides.guide import Guide

GLOSSARY = "Glossary"
# The guide to words that lead to other places, and are found there.
WORDS = "words.md"


@dataclass(slots=True)
class Section:
    """A heading with the text below it, and with the rows of the tables there.

    `above` are the headings that it stands below, without that of the guide.
    """

    id: str
    title: str
    above: tuple[str, ...] = ()
    text: list[str] = field(default_factory=list)
    rows: list[list[Token]] = field(default_factory=list)


def guide_entries(
    guide: Guide, abouts: Mapping[str, str], *, aside: bool = False
) -> Iterator[Entry]:
    """Yield a guide, with what the plan says of it, and its sections."""
    first, *others = sections(guide)
    text = " ".join([abouts.get(guide.path, ""), *first.text])
    yield Entry("guide", guide.title, guide.page, "Guide", text, aside=aside)
    if guide.path == WORDS:
        return
    for section in others:
        path = f"{guide.page}#{section.id}"
        where = ": ".join([f"Section of {guide.title}", *section.above])
        yield Entry("guide", section.title, path, where, " ".join(section.text), aside=aside)
        if section.title == GLOSSARY:
            for term, *meaning in section.rows[1:]:
                said = " ".join(plain_text(cell) for cell in meaning)
                yield Entry("guide", plain_text(term), path, GLOSSARY, said, aside=aside)


def sections(guide: Guide) -> list[Section]:
    """Return what stands in front of the first section of a guide, and then each of them."""
    found = [Section("", guide.title)]
    above = dict[int, str]()
    before, level, heading = "", 0, ""
    for token in guide.tokens:
        if before == "heading_open":
            if level > 1:
                title = plain_text(token)
                above = {higher: each for higher, each in above.items() if higher < level}
                found.append(Section(heading, title, (*above.values(),)))
                above[level] = title
        elif token.type == "tr_open":
            found[-1].rows.append([])
        elif token.type == "tr_close":
            cells = map(plain_text, found[-1].rows[-1])
            found[-1].text.append(f"{' · '.join(cells)};")
        elif token.type == "inline" and before in ("td_open", "th_open"):
            found[-1].rows[-1].append(token)
        elif token.type == "inline":
            found[-1].text.append(plain_text(token))
        elif token.type in ("fence", "code_block"):
            found[-1].text.append(token.content)
        if token.type == "heading_open":
            level, heading = int(token.tag[1]), str(token.attrGet("id"))
        before = token.type
    return found
