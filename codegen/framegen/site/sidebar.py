"""The navigation of all pages: the sections of the plan, with their guides and references."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Link:
    """A page by its path below the root of the site, and what it is called in the navigation."""

    path: str
    label: str


@dataclass(frozen=True, slots=True)
class Group:
    """Pages that belong together under a name, such as those of a protocol."""

    title: str
    path: str
    links: tuple[Link, ...]
    messages: tuple[Link, ...]


@dataclass(frozen=True, slots=True)
class SidebarSection:
    """A section of the plan: its guides, and the references in it."""

    title: str
    about: str
    links: tuple[Link, ...]
    groups: tuple[Group, ...]
