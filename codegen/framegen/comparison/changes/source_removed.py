"""Change: a source is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("source-removed", both.sources)


RULE = ChangeRule(
    id="source-removed",
    title="A source is gone",
    subject="document",
    why=(
        "Facts are cited from sources, and what kind of evidence one is tells how far to trust it."
    ),
    do="Nothing, once no fact is cited from it.",
    at="sources",
    before="bench: {title: A board on our desk, kind: observation}",
    after="",
    look=_look,
)
