"""Change: a message has another example."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("example-added", both.examples)


RULE = ChangeRule(
    id="example-added",
    title="A message has another example",
    subject="document",
    why="Every example is executed, and is evidence of what the spec says.",
    do="Nothing.",
    at="messages.LampRead",
    before="",
    after=(
        "examples:\n  - {title: Lamp 1, hex: AA 55 02 08 01, values: {lamp_id: 1}, cite: manual}"
    ),
    look=_look,
)
