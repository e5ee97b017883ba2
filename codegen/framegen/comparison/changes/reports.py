"""Change: other messages may follow one."""

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
        if [*map(both.message, each.old.reports)] != each.new.reports:
            # What only may be the same is told under the name that it had.
            old = ", ".join(map(both.certain_message, each.old.reports))
            new = ", ".join(each.new.reports)
            yield from changed("reports", each, "reports", old, new, "reports")


RULE = ChangeRule(
    id="reports",
    title="Other messages may follow one",
    subject="exchange",
    why="A client passes reports on to whoever listens for them; nobody waits for them.",
    do="Nothing: the messages themselves are compared on their own.",
    at="messages.LampsSet",
    before="",
    after="reports: [LampState]",
    look=_look,
)
