"""The words that people use for what is called something else here, and where they lead.

They are a guide of their own, with tables: words apart by commas, then what it is, with links.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.site.guides.markdown import plain_text
from framegen.site.search.entry import Entry
from framegen.site.search.guides import sections

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.site.guides.guide import Guide


def with_words(entries: Iterable[Entry], guide: Guide) -> Iterator[Entry]:
    """Yield entries, the first at each address with the words that lead there.

    Where no entry stands at such an address, there is one more.
    """
    led = dict[str, list[str]]()
    labels = dict[str, str]()
    for words, link, label in _rows(guide):
        led.setdefault(link, []).extend(words)
        labels.setdefault(link, label)
    for entry in entries:
        yield entry.called(tuple(led.pop(entry.path, ())))
    for link, words in led.items():
        yield Entry("page", labels[link], link, guide.title, also=tuple(words))


def _rows(guide: Guide) -> Iterator[tuple[list[str], str, str]]:
    """Yield words, the address that they lead to, and what the link says."""
    for section in sections(guide):
        for people_say, *cells in section.rows:
            words = [word.strip() for word in plain_text(people_say).split(",")]
            children = [child for cell in cells for child in cell.children or []]
            for at, child in enumerate(children):
                if child.type == "link_open" and child.attrGet("href"):
                    yield words, str(child.attrGet("href")), children[at + 1].content
