"""Change: there is another erratum."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("erratum-added", both.errata)


RULE = ChangeRule(
    id="erratum-added",
    title="There is another erratum",
    subject="document",
    why="An erratum tells where a document is wrong, with the evidence.",
    do="Nothing.",
    at="",
    before="",
    after=(
        "errata:\n"
        "  - title: The length is wrong.\n"
        "    cite: manual, section 2\n"
        "    concerns: {message: LampRead, fact: length}\n"
        "    document: 3\n"
        "    bytes: 2\n"
        "    here: It is 2.\n"
        "    why: Every frame has it."
    ),
    look=_look,
)
