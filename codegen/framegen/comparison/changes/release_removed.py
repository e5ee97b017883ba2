"""Change: a version in the history is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("release-removed", both.releases)


RULE = ChangeRule(
    id="release-removed",
    title="A version in the history is gone",
    subject="document",
    why="The history tells users what changed from version to version.",
    do="Keep it: users of that version look for it.",
    at="",
    before=('history:\n  - version: "1.0.0"\n    changes: [The first version.]'),
    after="",
    look=_look,
)
