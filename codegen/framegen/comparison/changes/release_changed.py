"""Change: a version in the history says something else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import called

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.releases.twins:
        if each.old.changes != each.new.changes:
            text = f"{called(each.new_path)}: the changes of {each.new.version} are told otherwise"
            paths = (*each.old_path, "changes"), (*each.new_path, "changes")
            yield Change("release-changed", *paths, text)


RULE = ChangeRule(
    id="release-changed",
    title="A version in the history says something else",
    subject="document",
    why="The history tells users what changed from version to version.",
    do="Nothing.",
    at="",
    before=('history:\n  - version: "1.0.0"\n    changes: [The first version.]'),
    after=('history:\n  - version: "1.0.0"\n    changes: [All began.]'),
    look=_look,
)
