"""The site: guides, references and tools as static pages, which need neither network nor server."""

from __future__ import annotations

from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.output import banner
from framegen.site.downloads import size_in_words
from framegen.site.escape import anchor, linked, said
from framegen.site.guide import Guide
from framegen.site.page import Page
from framegen.site.plan import README, Plan, Section
from framegen.site.policy import assets
from framegen.site.reference_pages import ReferencePages
from framegen.site.rule_pages import rule_pages
from framegen.site.shelf import Shelf, kept_page, shelf_of
from framegen.site.sidebar import Group, Link, SidebarSection
from framegen.site.versions import blaming
from framegen.targets.templates import environment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from jinja2 import Environment

    from framegen.comparison.edition import Edition
    from framegen.site.project import Project
    from framegen.targets.target import Snippets

_HERE = Path(__file__).parent


def render_site(project: Project, snippets: Snippets) -> dict[str, str]:
    """Render every page of a site, and the texts to download, by path below its root."""
    site = Site(project, snippets)
    return {page.path: _rendered(site, page) for page in site.pages} | site.files


@dataclass(frozen=True)
class Site:
    """All pages, and the navigation that they share."""

    project: Project
    snippets: Snippets

    @cached_property
    def plan(self) -> Plan | None:
        """What the README of the guides says, if there are guides."""
        readme = self.project.guides.get(README)
        return None if readme is None else Plan(readme)

    @cached_property
    def title(self) -> str:
        """What the site is called."""
        return "Reference" if self.plan is None else self.plan.title

    @cached_property
    def shelves(self) -> list[Shelf]:
        """The editions of each protocol."""
        return [
            shelf_of(spec, self.project.released.get(spec.spec.protocol.name, ()), self.snippets)
            for spec in self.project.specs
        ]

    @cached_property
    def references(self) -> list[ReferencePages]:
        """The reference of each protocol, as it is now."""
        return [self._reference(shelf, shelf.versions.newest) for shelf in self.shelves]

    @contextmanager
    def blaming(self, page: Page) -> Iterator[None]:
        """Say which older edition it is whose page goes wrong, if it is one of these."""
        older = next((each for each in self.older if each.folder == page.folder), None)
        with nullcontext() if older is None else blaming(older.edition):
            yield

    @cached_property
    def older(self) -> list[ReferencePages]:
        """The references of older editions, which the navigation leaves out."""
        return [
            self._reference(shelf, edition)
            for shelf in self.shelves
            for edition in shelf.versions.older
        ]

    def _reference(self, shelf: Shelf, edition: Edition) -> ReferencePages:
        return ReferencePages(shelf, edition, self.project, self._rules)

    @cached_property
    def _rules(self) -> dict[str, str]:
        return rule_pages(self.guides)

    @cached_property
    def files(self) -> dict[str, str]:
        """The texts that are no pages, by path below the root of the site."""
        found = {path: text for each in self.references for path, text in each.files.items()}
        for each in self.older:
            with blaming(each.edition):
                found |= each.files
        return found

    @cached_property
    def guides(self) -> list[Guide]:
        """The guides, those of the plan first and in its order."""
        order = [entry.link for section in self._sections for entry in section.entries]
        files = self.project.files
        texts = self.project.guides.items()
        found = [Guide(path, text, files) for path, text in texts if path != README]
        places = {path: place for place, path in enumerate(order)}
        return sorted(found, key=lambda guide: places.get(guide.path, len(places)))

    @property
    def _sections(self) -> list[Section]:
        return [] if self.plan is None else self.plan.sections

    @cached_property
    def sidebar(self) -> list[SidebarSection]:
        """The sections of the plan, with what they list; what it does not list comes last."""
        guides = {guide.path: guide for guide in self.guides}
        groups = {each.reference.folder: self._group(each) for each in self.references}
        found: list[SidebarSection] = []
        for section in self._sections:
            listed = [guides.pop(entry.link, None) for entry in section.entries]
            named = [groups.pop(entry.protocol, None) for entry in section.entries]
            links = [Link(guide.page, guide.title) for guide in listed if guide is not None]
            shown = [group for group in named if group is not None]
            found.append(SidebarSection(section.title, section.about, (*links,), (*shown,)))
        rest = [Link(guide.page, guide.title) for guide in guides.values()]
        if rest or groups:
            title = "More" if found else "Reference"
            found.append(SidebarSection(title, "", (*rest,), (*groups.values(),)))
        return found

    @staticmethod
    def _group(pages: ReferencePages) -> Group:
        protocol = pages.reference.protocol
        links = [Link(page.path, page.label) for page in pages.pages]
        end = len(pages.reference.pages)
        return Group(protocol.title, links[0].path, (*links[:end],), (*links[end:],))

    @cached_property
    def pages(self) -> list[Page]:
        """Every page: home, the guides, the references, and what belongs to all of them."""
        return list(self._made())

    def _made(self) -> Iterator[Page]:
        yield Page("index.html", "home", self.title, "Home", self.title)
        for guide in self.guides:
            yield Page(guide.page, "guide", guide.title, guide.title, "", context={"guide": guide})
        for reference in self.references:
            yield from reference.pages
        for older in self.older:
            with blaming(older.edition):
                pages = older.pages
            yield from pages
        for shelf in self.shelves:
            yield from kept_page(shelf)

    def neighbours(self, page: Page) -> tuple[Link | None, Link | None]:
        """Return the pages before and after a page, in the order of the navigation."""
        order = self._order
        if page.path not in order:
            return None, None
        at = list(order).index(page.path)
        links = list(order.values())
        return (links[at - 1] if at else None, links[at + 1] if at + 1 < len(links) else None)

    @cached_property
    def _order(self) -> dict[str, Link]:
        found = [
            link
            for section in self.sidebar
            for link in (
                *section.links,
                *(each for group in section.groups for each in (*group.links, *group.messages)),
            )
        ]
        return {link.path: link for link in found}


def _rendered(site: Site, page: Page) -> str:
    with site.blaming(page):
        return _filled(site, page)


def _filled(site: Site, page: Page) -> str:
    before, after = site.neighbours(page)
    reference = page.context.get("reference")
    return (
        _environment()
        .get_template(f"{page.template}.html.jinja")
        .render(
            {
                "site": site,
                "page": page,
                "reference": None,
                "edition": None,
                "before": before,
                "after": after,
                "banner": banner("" if reference is None else reference.spec),
                "assets": assets(page.scripts),
                **page.context,
            }
        )
    )


@cache
def _environment() -> Environment:
    made = environment(_HERE / "templates", "html", autoescape=True)
    made.filters |= {"anchor": anchor, "bytes": size_in_words, "linked": linked, "said": said}
    return made
