"""Change: a look-alike says something else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import called

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.lookalikes.twins:
        if each.is_renamed:
            text = f"{called(each.new_path)}: renamed from {each.old_path[-1]}"
            yield Change("lookalike-changed", each.old_path, each.new_path, text)
        for key in ("frame", "commands", "examples"):
            old, new = getattr(each.old, key), getattr(each.new, key)
            if repr(old) != repr(new):
                text = f"{called(each.new_path)}: {key} described otherwise"
                yield Change(
                    "lookalike-changed", (*each.old_path, key), (*each.new_path, key), text
                )


RULE = ChangeRule(
    id="lookalike-changed",
    title="A look-alike says something else",
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
    after=(
        "lookalikes:\n"
        "  dimmers:\n"
        "    title: Dimmers\n"
        "    about: Its frames begin with AA 77.\n"
        "    cite: manual\n"
        "    commands: {7: Dim.}"
    ),
    look=_look,
)
