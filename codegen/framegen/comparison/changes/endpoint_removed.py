"""Change: an end of the line is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("endpoint-removed", both.ends)


RULE = ChangeRule(
    id="endpoint-removed",
    title="An end of the line is gone",
    subject="program",
    why="Nobody answers for it any more, and the library has no class for its messages.",
    do="Remove its messages with it, or give it its new name in the same place.",
    at="",
    before="endpoints: {host: Commands., lamp: Shines., switch: Reports.}",
    after="endpoints: {host: Commands., lamp: Shines.}",
    look=_look,
)
