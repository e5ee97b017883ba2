"""Change: the ends are listed in another order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import moved

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from moved("endpoint-order", both.ends)


RULE = ChangeRule(
    id="endpoint-order",
    title="The ends are listed in another order",
    subject="program",
    why="The first end is the one that the library is for: its client sends what this end sends.",
    do="Turn them back, unless the library was for the wrong end.",
    at="",
    before="endpoints: {host: Commands., lamp: Shines.}",
    after="endpoints: {lamp: Shines., host: Commands.}",
    look=_look,
)
