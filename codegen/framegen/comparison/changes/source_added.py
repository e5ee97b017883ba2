"""Change: there is another source."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("source-added", both.sources)


RULE = ChangeRule(
    id="source-added",
    title="There is another source",
    subject="document",
    why=(
        "Facts are cited from sources, and what kind of evidence one is tells how far to trust it."
    ),
    do="Nothing.",
    at="sources",
    before="",
    after="bench: {title: A board on our desk, kind: observation}",
    look=_look,
)
