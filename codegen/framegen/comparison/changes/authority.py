"""Change: another source decides."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    protocol = both.part_of("protocol")
    old, new = both.source(protocol.old.authority), protocol.new.authority
    yield from changed("authority", protocol, "authority", old, new, "authority")


RULE = ChangeRule(
    id="authority",
    title="Another source decides",
    subject="document",
    why="Facts from all others are marked on the pages.",
    do="Nothing.",
    at="protocol",
    before="authority: manual",
    after="authority: board",
    look=_look,
)
