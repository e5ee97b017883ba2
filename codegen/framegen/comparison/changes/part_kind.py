"""Change: a part of the frame is of another kind."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.parts.twins:
        yield from changed("part-kind", each, "is", each.old.is_, each.new.is_)


RULE = ChangeRule(
    id="part-kind",
    title="A part of the frame is of another kind",
    subject="frame",
    why="The same bytes say something else, or are not checked any more.",
    do="Change both ends at once.",
    at="frame",
    before="header: {is: constant, bytes: AA 55}",
    after="header: {is: reserved, bytes: AA 55}",
    look=_look,
)
