"""Change: a source says something else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.changes.wording import called

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.sources.twins:
        if each.is_renamed:
            text = f"{called(each.new_path)}: renamed from {each.old_path[-1]}"
            yield Change("source-changed", each.old_path, each.new_path, text)
        yield from changed("source-changed", each, "kind", each.old.kind, each.new.kind, "kind")


RULE = ChangeRule(
    id="source-changed",
    title="A source says something else",
    subject="document",
    why=(
        "Facts are cited from sources, and what kind of evidence one is tells how far to trust it."
    ),
    do="Nothing.",
    at="sources",
    before="bench: {title: A board on our desk, kind: observation}",
    after="bench: {title: A board on our desk, kind: firmware}",
    look=_look,
)
