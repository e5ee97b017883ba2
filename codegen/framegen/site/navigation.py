"""How readers move through a site: the sidebar, the order of its pages, and the way back home."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.site.reading_order import beside
from framegen.site.sidebar import Group, Link, Messages, SidebarSection

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from framegen.site.guides.guide import Guide
    from framegen.site.guides.plan import Entry, Section
    from framegen.site.page import Page
    from framegen.site.reference_pages import ReferencePages
    from framegen.site.references import References


@dataclass(frozen=True)
class Navigation:
    """The guides and references of a site, in the order of its plan.

    `entries` are what the sections of the plan say of each, by link.
    """

    sections: Sequence[Section]
    entries: Mapping[str, Entry]
    guides: Sequence[Guide]
    references: References

    @cached_property
    def sidebar(self) -> list[SidebarSection]:
        """The sections of the plan, with what they list; what it does not list comes last."""
        guides = {guide.path: self.link(guide) for guide in self.guides}
        groups = {each.reference.folder: self._group(each) for each in self.references.newest}
        found: list[SidebarSection] = []
        for section in self.sections:
            listed = [guides.pop(entry.link, None) for entry in section.entries]
            named = [groups.pop(entry.protocol, None) for entry in section.entries]
            links = [link for link in listed if link is not None]
            shown = [group for group in named if group is not None]
            found.append(SidebarSection(section.title, section.about, (*links,), (*shown,)))
        if guides or groups:
            title = "More" if found else "Reference"
            found.append(SidebarSection(title, "", (*guides.values(),), (*groups.values(),)))
        return found

    @property
    def targets(self) -> frozenset[str]:
        """What the plan may list: each guide, and the README of each reference."""
        folders = (each.reference.folder for each in self.references.newest)
        readmes = (f"reference/{folder}/README.md" for folder in folders)
        return frozenset([*readmes, *(guide.path for guide in self.guides)])

    def link(self, guide: Guide) -> Link:
        """Return the link to a guide, with what the plan says of it."""
        entry = self.entries.get(guide.path)
        if entry is None:
            return Link(guide.page, guide.title, guide.about)
        return Link(guide.page, entry.label, entry.about)

    def neighbours(self, page: Page) -> tuple[Link | None, Link | None]:
        """Return the pages before and after a page, in the order of the navigation."""
        if page.path in self._places:
            return beside(self._order, page)
        older = self.references.of(page)
        return beside([Link(each.path, each.label) for each in older.pages] if older else (), page)

    def trail(self, page: Page) -> list[Link]:
        """Return the links that lead from home to a page, which is not among them."""
        home = Link("index.html", "Home")
        for section in self.sidebar:
            if section.holds(page):
                groups = [group for group in section.groups if group.holds(page)]
                above = [Link(group.path, group.title) for group in groups]
                here = Link(f"index.html#{section.id}", section.title)
                return [home, here, *(link for link in above if link.path != page.path)]
        return [] if page.path == home.path else [home, *self._trail_of_older(page)]

    def _trail_of_older(self, page: Page) -> Iterator[Link]:
        reference = self.references.of(page)
        if reference is not None:
            newest, title = reference.editions.folder, reference.reference.protocol.title
            yield Link(f"{newest}index.html", title)
            yield Link(f"{newest}changelog.html", "Versions")
            start = f"{reference.folder}index.html"
            if start != page.path:
                yield Link(start, reference.edition.version)

    def _group(self, pages: ReferencePages) -> Group:
        view = pages.reference
        entry = self.entries.get(f"reference/{view.folder}/README.md")
        title, about = (
            (view.protocol.title, view.protocol.summary)
            if entry is None
            else (entry.label, entry.about)
        )
        links = [Link(page.path, page.label, page.about) for page in pages.pages]
        end = len(view.pages)
        by_way = {way: list[Link]() for way in view.ways}
        for message, link in zip(view.messages, links[end:], strict=True):
            by_way[message.way].append(link)
        messages = [Messages(way, (*each,)) for way, each in by_way.items() if each]
        return Group(
            title, about, view.protocol.version, links[0].path, (*links[:end],), (*messages,)
        )

    @cached_property
    def _order(self) -> list[Link]:
        return [link for section in self.sidebar for link in section.every_link]

    @cached_property
    def _places(self) -> frozenset[str]:
        return frozenset(link.path for link in self._order)
