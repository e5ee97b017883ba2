"""The kinds of changes: a rule for each explains what became of one thing, and what it means."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from framegen.comparison.changes.both import Both
    from framegen.reading.yamltree import KeyPath

# What a rule is about. `document` is what neither frames nor libraries depend on but for words.
Subject: TypeAlias = Literal[
    "line", "frame", "message", "field", "value", "exchange", "program", "document"
]


@dataclass(frozen=True, slots=True)
class Change:
    """What became of one thing of a spec: `u16 became u32`, with its paths in both editions.

    `old` is None for what is new, and `new` for what is gone.
    """

    rule: str
    old: KeyPath | None
    new: KeyPath | None
    text: str

    @property
    def path(self) -> KeyPath:
        """The path in the new edition, or in the old where it is gone."""
        return self.old or () if self.new is None else self.new


@dataclass(frozen=True, slots=True)
class ChangeRule:
    """A kind of change: `why` it matters, and what to `do`, with an example of both editions.

    A rule says nothing of what breaks: that is tried out. `before` and `after` are lines of a spec
    below the path `at`. `id` is for programs to rely on, and stays.
    """

    id: str
    title: str
    subject: Subject
    why: str
    do: str
    at: str
    before: str
    after: str
    look: Callable[[Both], Iterator[Change]]
