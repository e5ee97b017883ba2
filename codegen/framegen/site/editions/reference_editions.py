"""The editions of a reference, and where in each of them a page has its like."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from framegen.site.editions.versions import Versions, newest_edition
from framegen.site.page import Page
from framegen.targets.docs.reference import PageView, ReferenceView

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.comparison.edition import Edition
    from framegen.compile import Compiled
    from framegen.targets.target import Snippets


@dataclass(frozen=True, slots=True)
class VersionLink:
    """A page of an edition by its path below the root of the site, and what became of its subject.

    `name` is what the message of the page is called there, if it is called otherwise, `certain`
    whether that is known. Of a message that is not there, `missing` says so, and the path leads to
    the start of that edition. `waits` says that the edition has yet to be released.
    """

    version: str
    path: str
    waits: bool = False
    name: str = ""
    certain: bool = True
    missing: bool = False


@dataclass(frozen=True, slots=True)
class EditionNotice:
    """The edition of a page, the newest one unless it is that itself, and all others.

    `pages` lead through an older edition, which the navigation leaves out.
    """

    own: VersionLink
    newest: VersionLink | None
    others: Sequence[VersionLink]
    pages: Sequence[PageView]

    @property
    def canonical(self) -> str:
        """The page that stands for it in search engines: the newest; "" for itself.

        Of a message that is gone, no other page tells.
        """
        return "" if self.newest is None or self.newest.missing else self.newest.path


@dataclass(frozen=True, eq=False)
class ReferenceEditions:
    """The editions of a reference, each with what its pages show.

    `folder` is that of the newest, below the root of the site.
    """

    versions: Versions
    views: dict[Edition, ReferenceView]
    folder: str

    def notice(self, edition: Edition, page: PageView) -> EditionNotice:
        """Return what a page of an edition says of it."""
        newest = self.versions.newest
        links = {each: self._link(edition, page, each) for each in self.versions.editions}
        return EditionNotice(
            links[edition],
            None if edition is newest else links[newest],
            [link for each, link in links.items() if each is not edition],
            [] if edition is newest else self.views[edition].pages,
        )

    def root(self, edition: Edition) -> str:
        """Return the folder of an edition, below the root of the site."""
        return f"{self.folder}{self.versions.folder(edition)}"

    def _link(self, edition: Edition, page: PageView, other: Edition) -> VersionLink:
        root, version = self.root(other), other.version
        waits = self.versions.waits(other)
        if page.message is None:
            pages = {each.html for each in self.views[other].pages}
            html = page.html if page.html in pages else "index.html"
            return VersionLink(version, f"{root}{html}", waits)
        names, guessed = self._names(edition, other)
        name = names.get(page.message.name)
        if name is None:
            return VersionLink(version, f"{root}index.html", waits, missing=True)
        return VersionLink(
            version,
            f"{root}{self.views[other].addresses[name]}",
            waits,
            "" if name == page.message.name else name,
            page.message.name not in guessed,
        )

    def _names(self, edition: Edition, other: Edition) -> tuple[dict[str, str], frozenset[str]]:
        """Return the messages of an edition as another calls them, and which of these are guesses.

        Of two older editions, what both have in common with the newest is the same.
        """
        to_newest, guessed = self._to_newest(edition)
        to_other, guessed_there = self._to_newest(other)
        back = {name: old for old, name in to_other.items()}
        found = {name: back[new] for name, new in to_newest.items() if new in back}
        return found, frozenset(
            name for name, old in found.items() if name in guessed or old in guessed_there
        )

    def _to_newest(self, edition: Edition) -> tuple[dict[str, str], frozenset[str]]:
        if edition is self.versions.newest:
            return {name: name for name in edition.model.messages}, frozenset()
        pairing = self.versions.pair(edition).messages
        return {**pairing.to_new}, pairing.guessed


def editions_of(
    compiled: Compiled, released: Sequence[Edition], snippets: Snippets
) -> ReferenceEditions:
    """Return the editions of a protocol: the spec as it is now, and what was released of it."""
    versions = Versions(newest_edition(compiled), released)
    views = {versions.newest: ReferenceView(compiled, snippets)}
    for each in versions.older:
        name = f"spec/released/{each.spec.protocol.name}-{each.version}.yaml"
        source = replace(each.compiled.source, path=name)
        views[each] = ReferenceView(replace(each.compiled, source=source), snippets)
    return ReferenceEditions(versions, views, f"reference/{views[versions.newest].folder}/")


def same_as_newest_page(editions: ReferenceEditions) -> Iterator[Page]:
    """Yield the page at the address of the last release, if the newest edition says the same.

    Its pages would be those of the newest edition again. Who has its address, as the pages of
    other editions do, is led there; later editions make it a reference of its own.
    """
    unchanged = editions.versions.unchanged
    if unchanged is not None:
        reference = editions.views[editions.versions.newest]
        start = f"{editions.folder}index.html"
        title = f"{reference.protocol.title} {unchanged.version}"
        yield Page(
            path=f"{editions.folder}{unchanged.version}/index.html",
            template="same_as_newest",
            title=title,
            label=title,
            about=f"Version {unchanged.version} is the newest one.",
            context={"start": start, "version": unchanged.version, "title": title},
            canonical=start,
        )
