"""Change: there is another reserved id or name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added
from framegen.comparison.changes.wording import reservation

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("reserved-added", both.reserved, lambda each: reservation(each.what))


RULE = ChangeRule(
    id="reserved-added",
    title="There is another reserved id or name",
    subject="document",
    why=(
        "What is reserved is never given to another message, so that nobody takes one for the "
        "other."
    ),
    do="Nothing.",
    at="",
    before="",
    after=("reserved:\n  - {id: 30, why: LampDim had it.}"),
    look=_look,
)
