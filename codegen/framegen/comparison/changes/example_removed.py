"""Change: an example of a message is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("example-removed", both.examples)


RULE = ChangeRule(
    id="example-removed",
    title="An example of a message is gone",
    subject="document",
    why="Every example is executed, and is evidence of what the spec says.",
    do="Where a document or a device gave it, find out why it does not hold any more.",
    at="messages.LampRead",
    before=(
        "examples:\n  - {title: Lamp 1, hex: AA 55 02 08 01, values: {lamp_id: 1}, cite: manual}"
    ),
    after="",
    look=_look,
)
