"""One page of the site: its address, what is said of it elsewhere, and what its template shows."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True, slots=True)
class Page:
    """A page by its path below the root of the site.

    `label` stands in the navigation, `about` in search results and previews. `folder` is the root
    of the reference that it belongs to, if it does to any. Each of `scripts` is made of files,
    and comes after the script of every page; `context` is what the template gets besides.
    `canonical` is the path of the page that stands for this one in search engines, if another does.
    `base` is the address of the site, on a page that is shown at any other.
    """

    path: str
    template: str
    title: str
    label: str
    about: str
    folder: str = ""
    scripts: tuple[tuple[str, ...], ...] = ()
    context: Mapping[str, Any] = field(default_factory=dict)
    canonical: str = ""
    base: str = ""

    @property
    def address(self) -> str:
        """The path of the page that stands for it; of an index, the folder."""
        return re.sub(r"(^|/)index\.html$", r"\1", self.canonical or self.path)

    @property
    def top(self) -> str:
        """The path from the page to the root of the site."""
        return self.base or "../" * self.path.count("/")

    @property
    def root(self) -> str:
        """The path from the page to the root of its reference."""
        return "../" * self.path.removeprefix(self.folder).count("/")

    @property
    def name(self) -> str:
        """The path within its reference, without its suffix."""
        return self.path.removeprefix(self.folder).removesuffix(".html")
