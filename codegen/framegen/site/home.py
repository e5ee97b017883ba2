"""The landing page: what the project is, a frame of it taken apart, and the ways into it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.explain import explain
from framegen.site.guides.guide import Guide, rendered

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framewire.explain.explanation import Row
    from markdown_it.token import Token
    from markupsafe import Markup

    from framegen.site.guides.plan import Plan
    from framegen.site.reference_pages import ReferencePages
    from framegen.targets.docs.examples import ExampleView
    from framegen.targets.docs.message import MessagePage


@dataclass(frozen=True)
class Introduction:
    """What the README of the guides says before its first section, and after its last list."""

    plan: Plan
    published: Mapping[str, str]

    @cached_property
    def _tokens(self) -> list[Token]:
        return Guide("README.md", self.plan.introduction, self.published).tokens

    @cached_property
    def _end(self) -> int:
        """Where the words end, and code begins."""
        kinds = [token.type for token in self._tokens]
        return kinds.index("fence") if "fence" in kinds else len(kinds)

    @property
    def words(self) -> Markup:
        """The paragraphs before the code."""
        return rendered(self._tokens[: self._end])

    @property
    def code(self) -> Markup:
        """The code with its output, and what follows it."""
        return rendered(self._tokens[self._end :])

    @property
    def rest(self) -> Markup:
        """The sections that list nothing."""
        return Guide("README.md", self.plan.rest, self.published).body


@dataclass(frozen=True)
class Specimen:
    """A documented frame of a protocol, with what each of its bytes means."""

    pages: ReferencePages
    example: ExampleView

    @property
    def message(self) -> MessagePage:
        """Its message."""
        views = self.pages.reference.messages
        return next(view for view in views if view.name == self.example.message)

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """Its parts, and what each says."""
        direction = self.message.layout.direction
        found = explain(self.pages.reference.model, self.example.data, [direction])
        return found.readings[0].rows


def specimen(pages: ReferencePages) -> Specimen | None:
    """Return the first documented frame of a protocol, if it has any."""
    sequences = pages.reference.example_sequences
    return Specimen(pages, sequences[0].request) if sequences else None
