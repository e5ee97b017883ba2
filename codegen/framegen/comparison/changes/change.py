"""The kinds of changes: a rule for each explains what became of one thing, and what it means."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from framegen.comparison.pair import Pair
    from framegen.reading.yamltree import KeyPath


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
        return self.new or self.old or ()


@dataclass(frozen=True, slots=True)
class ChangeRule:
    """A kind of change: `why` it matters, and what to `do`, with an example of both editions.

    A rule says nothing of what breaks: that is tried out. `before` and `after` are lines of a spec.
    `id` is for programs to rely on, and stays.
    """

    id: str
    title: str
    why: str
    do: str
    before: str
    after: str
    look: Callable[[Pair], Iterator[Change]]
