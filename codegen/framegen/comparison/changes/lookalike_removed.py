"""Change: a look-alike is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("lookalike-removed", both.lookalikes)


RULE = ChangeRule(
    id="lookalike-removed",
    title="A look-alike is gone",
    subject="document",
    why="A protocol that is easily taken for this one is told of in errors and on pages.",
    do="Nothing.",
    at="",
    before=(
        "lookalikes:\n"
        "  dimmers:\n"
        "    title: Dimmers\n"
        "    about: Its frames begin with AA 77.\n"
        "    cite: manual"
    ),
    after="",
    look=_look,
)
