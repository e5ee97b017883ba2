"""Change: there is another open question."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("unknown-added", both.unknowns)


RULE = ChangeRule(
    id="unknown-added",
    title="There is another open question",
    subject="document",
    why="A question that no source answers is asked where the facts are.",
    do="Nothing.",
    at="",
    before="",
    after=("unknowns:\n  - {concerns: {message: LampRead}, what: Whether lamp 0 answers.}"),
    look=_look,
)
