"""Change: a fact is cited from another place."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for twin in both.everything():
        old, new = (getattr(one, "cite", None) for one in (twin.old, twin.new))
        if old is not None:
            old = replace(old, source=both.source(old.source))
        yield from changed("citation", twin, "cite", old, new, "cited from")


RULE = ChangeRule(
    id="citation",
    title="A fact is cited from another place",
    subject="document",
    why="It is how readers find where a fact is known from.",
    do="Nothing.",
    at="messages.LampRead",
    before="cite: manual, section 2",
    after="cite: manual, section 3",
    look=_look,
)
