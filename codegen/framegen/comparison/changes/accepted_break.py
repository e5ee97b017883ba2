"""Change: the history accepts another break, or one less."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import became, called

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.releases.twins:
        old, new = each.old.breaks, each.new.breaks
        sides = (*each.old_path, "breaks"), (*each.new_path, "breaks")
        for path in dict.fromkeys([*old, *new]):
            if old.get(path) != new.get(path):
                before, after = (
                    (*side, path) if path in there else side
                    for side, there in zip(sides, (old, new), strict=True)
                )
                what = became(f"break of {path} accepted:", old.get(path), new.get(path))
                yield Change("accepted-break", before, after, f"{called(each.new_path)}: {what}")
        if list(old) != list(new) and old == new:
            text = f"{called(each.new_path)}: accepted breaks are listed in another order"
            yield Change("accepted-break", *sides, text)


RULE = ChangeRule(
    id="accepted-break",
    title="The history accepts another break, or one less",
    subject="document",
    why="A break that is accepted with its reason does not fail a comparison.",
    do="Accept what is intended, in the newest version of the history.",
    at="",
    before=('history:\n  - version: "1.0.0"\n    changes: [The first version.]'),
    after=(
        "history:\n"
        '  - version: "1.0.0"\n'
        "    changes: [The first version.]\n"
        "    breaks: {link.baud: Nobody used it.}"
    ),
    look=_look,
)
