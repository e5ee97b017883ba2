"""The navigation of all pages: the sections of the plan, with their guides and references."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.site.guides.markdown import slug

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.site.page import Page
    from framegen.targets.docs.way import Way

# Messages of one direction are all in sight if there are no more.
_FEW = 16


@dataclass(frozen=True, slots=True)
class Link:
    """A page by its path below the root of the site, and what it is called in the navigation."""

    path: str
    label: str
    about: str = ""


@dataclass(frozen=True, slots=True)
class Messages:
    """The messages of a protocol in one direction."""

    way: Way
    links: tuple[Link, ...]

    def opens_on(self, page: Page) -> bool:
        """Tell whether they are in sight on a page of their protocol."""
        return len(self.links) <= _FEW or any(link.path == page.path for link in self.links)


@dataclass(frozen=True, slots=True)
class Group:
    """The pages of a protocol: those about all of it, and its messages by direction."""

    title: str
    about: str
    version: str
    path: str
    links: tuple[Link, ...]
    messages: tuple[Messages, ...]

    @property
    def every_link(self) -> Iterator[Link]:
        """All its pages, in order."""
        yield from self.links
        for messages in self.messages:
            yield from messages.links

    def holds(self, page: Page) -> bool:
        """Tell whether a page is one of its pages."""
        return any(link.path == page.path for link in self.every_link)


@dataclass(frozen=True, slots=True)
class SidebarSection:
    """A section of the plan: the references in it, and its guides."""

    title: str
    about: str
    links: tuple[Link, ...]
    groups: tuple[Group, ...]

    @property
    def id(self) -> str:
        """Its anchor on the landing page."""
        return slug(self.title)

    @property
    def every_link(self) -> Iterator[Link]:
        """All pages in it, in order."""
        for group in self.groups:
            yield from group.every_link
        yield from self.links

    @property
    def first(self) -> tuple[Link, ...]:
        """The page to begin with, if there is any."""
        groups = (Link(group.path, group.title) for group in self.groups)
        return (*groups, *self.links)[:1]

    def holds(self, page: Page) -> bool:
        """Tell whether a page is in it."""
        return any(link.path == page.path for link in self.every_link)
