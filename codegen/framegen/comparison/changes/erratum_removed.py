"""Change: an erratum is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("erratum-removed", both.errata)


RULE = ChangeRule(
    id="erratum-removed",
    title="An erratum is gone",
    subject="document",
    why="An erratum tells where a document is wrong, with the evidence.",
    do="Nothing, where the document was corrected.",
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
    after="",
    look=_look,
)
