"""Change: an erratum says something else."""

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
    for each in both.errata.twins:
        # What was left under its old name is the same all the same.
        if each.old.concerns != each.new.concerns:
            old, new = both.concern(each.old.concerns), concern(each.new.concerns)
            yield from changed("erratum-changed", each, "concerns", old, new, "concerns")
        for key in ("document", "bytes_"):
            old, new = repr(getattr(each.old, key)), repr(getattr(each.new, key))
            name = key.rstrip("_")
            yield from changed("erratum-changed", each, name, old, new, name)


RULE = ChangeRule(
    id="erratum-changed",
    title="An erratum says something else",
    subject="document",
    why="An erratum tells where a document is wrong, with the evidence.",
    do="Nothing.",
    at="",
    before=(
        "errata:\n"
        "  - title: The length is wrong.\n"
        "    cite: manual, section 2\n"
        "    concerns: {message: LampRead, fact: length}\n"
        "    document: 3\n"
        "    bytes: 2\n"
        "    here: It is 2.\n"
        "    why: Every frame has it."
    ),
    after=(
        "errata:\n"
        "  - title: The length is wrong.\n"
        "    cite: manual, section 2\n"
        "    concerns: {message: LampRead, fact: length}\n"
        "    document: 4\n"
        "    bytes: 2\n"
        "    here: It is 2.\n"
        "    why: Every frame has it."
    ),
    look=_look,
)
