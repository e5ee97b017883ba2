"""The site: guides, references and tools as static pages, which need neither network nor server."""

from __future__ import annotations

import posixpath
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import quote

from markupsafe import Markup

from framegen import __version__
from framegen.site.escape import script_json
from framegen.site.guides.guide import Guide, page_of
from framegen.site.guides.linked_files import is_linked, link_to
from framegen.site.guides.links import FOLDER
from framegen.site.guides.lost import lost_in, lost_in_plan
from framegen.site.guides.mentions import Mention, Mentions
from framegen.site.guides.plan import README, Entry, Plan, Section
from framegen.site.guides.rule_pages import rule_pages
from framegen.site.home import Introduction, specimen
from framegen.site.logo import icon, logo
from framegen.site.navigation import Navigation
from framegen.site.page import Page
from framegen.site.publication import NOT_FOUND, robots, sitemap
from framegen.site.reading_order import refuse_twins
from framegen.site.references import References
from framegen.site.rendering import render_page
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.search.index import SearchIndex

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.language.site_settings import SiteSettings
    from framegen.site.project import Project
    from framegen.site.reference_pages import ReferencePages
    from framegen.site.sidebar import SidebarSection
    from framegen.targets.target import Snippets

_PREVIEW = "images/preview.png"


class Edited(NamedTuple):
    """Where the file of a page is edited, in words and as an address."""

    words: str
    address: str


def render_site(project: Project, snippets: Snippets) -> dict[str, str]:
    """Render every page of a site, and the texts to download, by path below its root."""
    return rendered(Site(project, snippets))


def rendered(site: Site) -> dict[str, str]:
    """Render the same of a site that may be asked for more."""
    project = site.project
    refuse_twins(site.guides, site.pages)
    files = {page.path: render_page(site, page) for page in site.pages} | site.collection.files
    if project.base:
        # Where a page stands for another, or for none at all, it is not for search engines.
        listed = [
            page.address for page in site.pages if not page.canonical and page.path != NOT_FOUND
        ]
        files["sitemap.xml"] = sitemap(project.base, listed)
        files["robots.txt"] = robots(project.base)
    return files


def lost(site: Site, files: Mapping[str, str]) -> Iterator[str]:
    """Yield what of the guides is not in the rendered files: where, what, and the way out."""
    if site.plan is not None:
        readme = Guide(README, site.plan.readme, site.published)
        yield from lost_in_plan(
            readme, site.plan, site.navigation.targets, files, site.project.folder
        )
    for guide in site.guides:
        yield from lost_in(guide, files, site.project.folder)


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
        """What the site is called: as its author says, its README, or else its only protocol."""
        if self.look.title:
            return self.look.title
        if self.plan is not None:
            return self.plan.title
        titles = [each.reference.protocol.title for each in self.references]
        return titles[0] if len(titles) == 1 else "Reference"

    @property
    def generator(self) -> str:
        """The version of framegen."""
        return __version__

    @property
    def look(self) -> SiteSettings:
        """What the author of the site has set."""
        return self.project.look.settings

    def logo(self, page: Page) -> Markup:
        """Return the logo beside the title."""
        path = self.project.look.logo
        if path:
            return Markup('<img src="{}" alt="">').format(page.top + quote(path))
        return logo(self.project.look.accent)

    def icon(self, page: Page) -> str:
        """Return the address of the icon of all pages."""
        path = self.project.look.icon
        return page.top + quote(path) if path else icon(self.project.look.accent)

    def edited(self, page: Page) -> Edited | None:
        """Return where the file is edited that a page is made of, if that can be said."""
        reference = self.collection.of(page)
        path, words = "", "Edit this page"
        if reference in self.references:
            path, words = reference.reference.spec, "Edit the spec"
        elif page.template == "guide":
            path = posixpath.normpath(f"{FOLDER}/{page.context['guide'].path}")
        elif page.template == "home" and self.plan is not None:
            path = f"{FOLDER}/{README}"
        address = self.project.look.edit_address(path) if path else ""
        return Edited(words, address) if address else None

    @property
    def preview(self) -> str:
        """The picture that stands for the site elsewhere, if it has one."""
        return _PREVIEW if _PREVIEW in self.project.files else ""

    def full_title(self, page: Page) -> str:
        """Return the title of a page with that of the site, or of the reference it belongs to."""
        reference = self.collection.of(page)
        name = "" if reference is None else reference.full_title
        whole = name if name not in ("", page.title) else self.title
        return page.title if page.title == whole else f"{page.title} \u2013 {whole}"

    @cached_property
    def collection(self) -> References:
        """The references of all editions."""
        return References(self.project, self.snippets, lambda: self._rule_pages)

    @cached_property
    def _rule_pages(self) -> dict[str, str]:
        return rule_pages(self.guides)

    @property
    def references(self) -> list[ReferencePages]:
        """The reference of each protocol, as it is now."""
        return self.collection.newest

    @cached_property
    def guides(self) -> list[Guide]:
        """The guides, those of the plan first and in its order."""
        found = [
            Guide(path, text, self.published)
            for path, text in self.project.guides.items()
            if path != README
        ]
        places = {path: place for place, path in enumerate(self._entries)}
        return sorted(found, key=lambda guide: places.get(guide.path, len(places)))

    @cached_property
    def published(self) -> dict[str, str]:
        """What a link of a guide may lead to: files by path below the guides, and their pages."""
        found = {link_to(path) if is_linked(path) else path: path for path in self.project.files}
        found |= {path: page_of(path) for path in self.project.guides}
        for pages in self.references:
            view, above = pages.reference, f"reference/{pages.reference.folder}/"
            found |= {
                f"{above}{each.markdown}": f"{pages.folder}{each.html}"
                for each in (*view.pages, *view.message_pages)
            }
            found[f"../{view.spec}"] = f"{pages.folder}spec.html"
            found[f"{above}README.md#workbench"] = f"{pages.folder}decoder.html"
        return found

    @cached_property
    def _entries(self) -> dict[str, Entry]:
        """What the plan says of each guide and reference, by link."""
        return {entry.link: entry for section in self._sections for entry in section.entries}

    @property
    def _sections(self) -> list[Section]:
        return [] if self.plan is None else self.plan.sections

    @cached_property
    def navigation(self) -> Navigation:
        """The ways between its pages."""
        return Navigation(self._sections, self._entries, self.guides, self.collection)

    @property
    def sidebar(self) -> list[SidebarSection]:
        """The sections of the navigation."""
        return self.navigation.sidebar

    @cached_property
    def pages(self) -> list[Page]:
        """Every page: home, the guides, the references, and what belongs to all of them."""
        return list(self._made())

    def _made(self) -> Iterator[Page]:
        yield Page("index.html", "home", self.title, "Home", self._about, context=self._home)
        for guide in self.guides:
            link = self.navigation.link(guide)
            yield Page(
                guide.page, "guide", guide.title, link.label, link.about, context={"guide": guide}
            )
        yield from self.collection.pages
        yield self._search_page()
        if self.project.base:
            # It is shown at any address, so that its links are whole.
            yield Page(
                NOT_FOUND,
                "404",
                "There is no such page",
                "",
                "Nothing is at this address.",
                base=self.project.base,
            )

    def _search_page(self) -> Page:
        about = f"Search {self.title}: names, ids, words and bytes, without a network."
        models = [each.reference.model for each in self.references]
        codec = max(map(codec_scripts, models), key=len, default=("hex",))
        scripts = (
            codec,
            ("elements", "matching", "ranking", "snippet", "bytes_found"),
            ("search",),
        )
        context = {"data": script_json(self.search.data)}
        return Page("search.html", "search", "Search", "Search", about, "", scripts, context)

    @cached_property
    def search(self) -> SearchIndex:
        """All that can be found."""
        abouts = {link: entry.about for link, entry in self._entries.items()}
        return SearchIndex(self.references, self.guides, abouts, self._for_users)

    @property
    def _about(self) -> str:
        """The first paragraph of the introduction; without one, what the references are of."""
        if self.plan is not None:
            return Guide(README, self.plan.introduction).about
        titles = [each.reference.protocol.title for each in self.references]
        return f"The reference of {', '.join(titles)}: every message, byte by byte."

    @property
    def _home(self) -> dict[str, object]:
        plan = self.plan
        first = next(
            (group.path for section in self.sidebar for group in section.groups), "index.html"
        )
        shown = [each for each in self.references if first.startswith(each.folder)]
        return {
            "workbench": f"{shown[0].folder}decoder.html" if shown else "",
            "introduction": None if plan is None else Introduction(plan, self.published),
            "specimen": next(map(specimen, shown), None),
        }

    def mentions(self, page: Page) -> list[Mention]:
        """Return where the guides speak of the message of a page: as it is now, not as it was."""
        if self.collection.is_older(page):
            return []
        return [*self._mentions.of(page.context["message"], page.path)]

    @cached_property
    def _mentions(self) -> Mentions:
        return Mentions(self._for_users)

    @cached_property
    def _for_users(self) -> list[Guide]:
        """The guides of the sections down to the one that lists the references."""
        listing = [at for at, section in enumerate(self.sidebar) if section.groups]
        shown = self.sidebar[: listing[0] + 1] if listing else self.sidebar
        paths = {link.path for section in shown for link in section.links}
        return [guide for guide in self.guides if guide.page in paths]
