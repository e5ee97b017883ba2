"""The index of the search: every entry, and what the page needs to judge bytes."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from framegen.site.scripts.protocol_data import protocol_data
from framegen.site.search.entry import KINDS, Entry
from framegen.site.search.guides import WORDS, guide_entries
from framegen.site.search.reference import reference_entries
from framegen.site.search.words import with_words

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from framegen.site.guides.guide import Guide
    from framegen.site.reference_pages import ReferencePages

# What no page that lists all needs to list.
_UNLISTED = ("frame",)


@dataclass(frozen=True, slots=True)
class Letter:
    """Entries that begin with the same letter."""

    letter: str
    id: str
    entries: tuple[Entry, ...]


@dataclass(frozen=True)
class SearchIndex:
    """All that can be found in references, in guides, and of what the plan says of these.

    `for_users` are the guides that are not aside.
    """

    references: Sequence[ReferencePages]
    guides: Sequence[Guide]
    abouts: Mapping[str, str]
    for_users: Sequence[Guide]

    @cached_property
    def entries(self) -> list[Entry]:
        """Every entry: those of the references, then those of the guides."""
        words = next((guide for guide in self.guides if guide.path == WORDS), None)
        return [*(self._found() if words is None else with_words(self._found(), words))]

    def _found(self) -> Iterator[Entry]:
        for each in self.references:
            yield from reference_entries(each.reference, each.folder)
        for guide in self.guides:
            yield from guide_entries(guide, self.abouts, aside=guide not in self.for_users)

    @property
    def data(self) -> dict[str, Any]:
        """The index as plain data; `protocols` hold what decodes their frames."""
        return {
            "kinds": KINDS,
            "protocols": [
                {
                    "name": each.reference.protocol.name,
                    "title": each.reference.protocol.title,
                    "folder": each.folder,
                    "data": protocol_data(each.reference.model),
                }
                for each in self.references
            ],
            "entries": [entry.data for entry in self.entries],
        }

    @cached_property
    def titles(self) -> dict[str, str]:
        """What people call each protocol, by its name."""
        protocols = [each.reference.protocol for each in self.references]
        return {protocol.name: protocol.title for protocol in protocols}

    @property
    def letters(self) -> list[Letter]:
        """The entries by their first letters; what begins with none comes first."""
        found: dict[str, list[Entry]] = {}
        listed = (entry for entry in self.entries if entry.kind not in _UNLISTED)
        for entry in sorted(listed, key=lambda entry: (_sorted_by(entry.title), entry.where)):
            first = _sorted_by(entry.title)[:1].upper()
            found.setdefault(first if "A" <= first <= "Z" else "", []).append(entry)
        return [
            Letter(letter or "0 to 9", f"letter-{letter or 'other'}", (*entries,))
            for letter, entries in sorted(found.items())
        ]


def _sorted_by(title: str) -> str:
    """Return a title without the number that a section may have, in lower case."""
    return re.sub(r"^\d+\.\s+", "", title).lower()
