"""The references of a site: the newest edition of each protocol, and all older ones."""

from __future__ import annotations

from contextlib import contextmanager, nullcontext
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.site.editions.reference_editions import (
    ReferenceEditions,
    editions_of,
    same_as_newest_page,
)
from framegen.site.editions.versions import blaming
from framegen.site.reference_pages import ReferencePages

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from framegen.comparison.edition import Edition
    from framegen.site.page import Page
    from framegen.site.project import Project
    from framegen.targets.target import Snippets


class References:
    """All references; `rules` gives the pages about kinds of changes, once the guides are there."""

    def __init__(
        self, project: Project, snippets: Snippets, rules: Callable[[], Mapping[str, str]]
    ) -> None:
        """Take what is to be shown."""
        self._project = project
        self._rules = rules
        self._editions = [
            editions_of(spec, project.released.get(spec.spec.protocol.name, ()), snippets)
            for spec in project.specs
        ]

    @cached_property
    def newest(self) -> list[ReferencePages]:
        """The reference of each protocol, as it is now."""
        return [self._reference(editions, editions.versions.newest) for editions in self._editions]

    @cached_property
    def older(self) -> list[ReferencePages]:
        """The references of older editions, which the navigation leaves out."""
        return [
            self._reference(editions, edition)
            for editions in self._editions
            for edition in editions.versions.older
        ]

    def _reference(self, editions: ReferenceEditions, edition: Edition) -> ReferencePages:
        return ReferencePages(editions, edition, self._project, self._rules)

    @property
    def pages(self) -> Iterator[Page]:
        """The pages of all, those of the newest editions first."""
        for reference in self.newest:
            yield from reference.pages
        for reference in self.older:
            with blaming(reference.edition):
                pages = reference.pages
            yield from pages
        for editions in self._editions:
            yield from same_as_newest_page(editions)

    @cached_property
    def files(self) -> dict[str, str]:
        """The texts that are no pages, by path below the root of the site."""
        found = {path: text for each in self.newest for path, text in each.files.items()}
        for each in self.older:
            with blaming(each.edition):
                found |= each.files
        return found

    def of(self, page: Page) -> ReferencePages | None:
        """Return the reference that a page belongs to, if it does to one."""
        every = (*self.newest, *self.older)
        return next((each for each in every if each.folder == page.folder), None)

    def is_older(self, page: Page) -> bool:
        """Tell whether a page is one of an older edition."""
        return self.of(page) in self.older

    @contextmanager
    def blaming(self, page: Page) -> Iterator[None]:
        """Say which older edition it is whose page goes wrong, if it is one of these."""
        reference = self.of(page)
        with nullcontext() if reference not in self.older else blaming(reference.edition):
            yield
