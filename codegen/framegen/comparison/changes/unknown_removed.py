"""Change: an open question is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("unknown-removed", both.unknowns)


RULE = ChangeRule(
    id="unknown-removed",
    title="An open question is gone",
    subject="document",
    why="A question that no source answers is asked where the facts are.",
    do="Cite what answered it.",
    at="",
    before=("unknowns:\n  - {concerns: {message: LampRead}, what: Whether lamp 0 answers.}"),
    after="",
    look=_look,
)
