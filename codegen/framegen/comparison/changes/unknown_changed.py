"""Change: an open question says something else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.changes.wording import concern

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.unknowns.twins:
        # What was left under its old name is the same all the same.
        if each.old.concerns != each.new.concerns:
            old, new = both.concern(each.old.concerns), concern(each.new.concerns)
            yield from changed("unknown-changed", each, "concerns", old, new, "concerns")


RULE = ChangeRule(
    id="unknown-changed",
    title="An open question says something else",
    subject="document",
    why="A question that no source answers is asked where the facts are.",
    do="Nothing.",
    at="",
    before=("unknowns:\n  - {concerns: {message: LampRead}, what: Whether lamp 0 answers.}"),
    after=("unknowns:\n  - {concerns: {message: LampsSet}, what: Whether lamp 0 answers.}"),
    look=_look,
)
