"""Change: there is another version in the history."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("release-added", both.releases)


RULE = ChangeRule(
    id="release-added",
    title="There is another version in the history",
    subject="document",
    why="The history tells users what changed from version to version.",
    do="Nothing.",
    at="",
    before="",
    after=('history:\n  - version: "1.0.0"\n    changes: [The first version.]'),
    look=_look,
)
