"""Citations: the source of a fact, and its place in the spec."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.reading.yamltree import dotted

if TYPE_CHECKING:
    from framegen.language.spec import Spec
    from framegen.language.values import Citation
    from framegen.reading.yamltree import KeyPath


@dataclass(frozen=True, slots=True)
class CiteView:
    """A citation; `marked` says that its source is not the one that decides."""

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
    def badge(self) -> str:
        """The kind of evidence, for another source than the one that decides, and not named so."""
        return self.kind if self.marked and self.kind not in self.title.lower() else ""

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
class Place:
    """A place in the spec, by the keys that lead to it, which stays when lines move."""

    keys: KeyPath

    @property
    def text(self) -> str:
        """The keys as people write them: `messages.ServoMove.fields.time_ms`."""
        return dotted(self.keys)

    @property
    def html(self) -> str:
        """The address in the reference, relative to its root."""
        return f"spec.html#{self.text}"
