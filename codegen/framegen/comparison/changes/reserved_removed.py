"""Change: a reserved id or name is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed
from framegen.comparison.changes.wording import reservation

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("reserved-removed", both.reserved, lambda each: reservation(each.what))


RULE = ChangeRule(
    id="reserved-removed",
    title="A reserved id or name is gone",
    subject="message",
    why=(
        "What is reserved is never given to another message, so that nobody takes one for the "
        "other."
    ),
    do="Keep it as long as any end still sends what had it.",
    at="",
    before=("reserved:\n  - {id: 30, why: LampDim had it.}"),
    after="",
    look=_look,
)
