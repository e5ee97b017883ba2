"""Change: the line runs at another rate."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    link = both.part_of("link")
    yield from changed("baud", link, "baud", link.old.baud, link.new.baud, "baud")


RULE = ChangeRule(
    id="baud",
    title="The line runs at another rate",
    subject="line",
    why="At another rate nothing that one end sends is understood by the other: it hears noise.",
    do="Change both ends at once, or let programs say the rate where they open the line.",
    at="link",
    before="baud: 9600",
    after="baud: 115200",
    look=_look,
)
