"""The kinds of rules: id, reason, an example of each side, and the check itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from framegen.reading.findings import Finding, Related
from framegen.reading.yamltree import dotted

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from framegen.language.spec import Spec
    from framegen.model.model import Model
    from framegen.reading.source import Span
    from framegen.reading.yamltree import KeyPath, Tree


@dataclass(frozen=True, slots=True)
class Problem:
    """A violation of a rule, by path; `on_key` points at the key instead of its value.

    A hint that takes a search among many names is a function, called only for findings that are
    shown.
    """

    path: KeyPath
    message: str
    hint: str | Callable[[], str] = ""
    on_key: bool = False
    also: tuple[KeyPath, str] | None = None

    def span(self, tree: Tree) -> Span:
        """Return the place in the text."""
        return tree.key_at(self.path) if self.on_key else tree.value_at(self.path)

    def finding(self, rule: str, tree: Tree, *, hinted: bool = True) -> Finding:
        """Make a finding of the problem; a hint that has to be searched for only if asked to."""
        related = () if self.also is None else (Related(tree.key_at(self.also[0]), self.also[1]),)
        hint = self.hint if isinstance(self.hint, str) else self.hint() if hinted else ""
        return Finding(rule, self.span(tree), dotted(self.path), self.message, hint, related)


@dataclass(frozen=True, slots=True)
class StructureRule:
    """A rule about the spec as written. The model is derived only once all of these hold."""

    id: str
    title: str
    why: str
    bad: str
    good: str
    look: Callable[[Spec], Iterator[Problem]]


@dataclass(frozen=True, slots=True)
class ModelRule:
    """A rule about what follows from the spec."""

    id: str
    title: str
    why: str
    bad: str
    good: str
    look: Callable[[Model], Iterator[Problem]]


@dataclass(frozen=True, slots=True)
class ReadingRule:
    """A rule that is checked while a spec is read."""

    id: str
    title: str
    why: str
    bad: str
    good: str


AnyRule: TypeAlias = ReadingRule | StructureRule | ModelRule
