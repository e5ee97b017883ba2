"""Change: a message is said to exist since another version."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        yield from changed("since", each, "since", each.old.since, each.new.since, "since")


RULE = ChangeRule(
    id="since",
    title="A message is said to exist since another version",
    subject="document",
    why="It is for readers alone.",
    do="Nothing.",
    at="messages.LampRead",
    before="",
    after='since: "1.0.0"',
    look=_look,
)
