"""Change: the line has another end."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("endpoint-added", both.ends)


RULE = ChangeRule(
    id="endpoint-added",
    title="The line has another end",
    subject="program",
    why="A new end may talk to old ones. The first two ends are those that the library is for.",
    do="Nothing, unless it came first: then the library is for another end.",
    at="",
    before="endpoints: {host: Commands., lamp: Shines.}",
    after="endpoints: {host: Commands., lamp: Shines., switch: Reports.}",
    look=_look,
)
