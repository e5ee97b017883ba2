"""Change: the spec is written in another edition of the language."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import became

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    old, new = both.old.framegen, both.new.framegen
    if old != new:
        path = ("framegen",)
        yield Change("language-edition", path, path, became("edition", old, new))


RULE = ChangeRule(
    id="language-edition",
    title="The spec is written in another edition of the language",
    subject="program",
    why=(
        "An edition may say what a key means otherwise: from the second on, the first end is the "
        "client."
    ),
    do="Look at what else is said to have changed: of itself, the edition says nothing.",
    at="",
    before="framegen: 1",
    after="framegen: 2",
    look=_look,
)
