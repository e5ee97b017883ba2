"""Where a fact is known from, and where in the spec it is written down."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.spec import Spec
    from framegen.language.values import Citation
    from framegen.reading.yamltree import KeyPath, Tree


@dataclass(frozen=True, slots=True)
class CiteView:
    """A citation; `marked` says that it is not the source which decides."""

    name: str
    title: str
    place: str
    kind: str
    marked: bool

    @property
    def text(self) -> str:
        """The source by its title, and the place in it."""
        return f"{self.title}, {self.place}" if self.place else self.title

    @property
    def short(self) -> str:
        """The source by its short name, and the place in it."""
        return f"{self.name}, {self.place}" if self.place else self.name


def cite_view(spec: Spec, cite: Citation) -> CiteView:
    """Look up the source of a citation."""
    source = spec.sources[cite.source]
    marked = cite.source != spec.protocol.authority
    return CiteView(cite.source, source.title, cite.place, source.kind, marked)


@dataclass(frozen=True, slots=True)
class Lines:
    """Lines of the spec, counted from 1, both ends among them."""

    first: int
    last: int

    @property
    def text(self) -> str:
        """Which lines they are, in words."""
        if self.first == self.last:
            return f"line {self.first}"
        return f"lines {self.first} to {self.last}"

    @property
    def html(self) -> str:
        """The address in the reference, without the way to its root."""
        return f"spec.html#L{self.first}"

    @property
    def forge(self) -> str:
        """The fragment that forges understand."""
        return f"#L{self.first}" if self.first == self.last else f"#L{self.first}-L{self.last}"


def lines_of(tree: Tree, path: KeyPath) -> Lines:
    """Find the lines that a value takes, its key among them."""
    first = tree.key_at(path).line
    return Lines(first, max(first, tree.last_line(path)))
