"""Change: a note is gone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("note-removed", both.notes)


RULE = ChangeRule(
    id="note-removed",
    title="A note is gone",
    subject="document",
    why="A note is a fact that no codec enforces.",
    do="Nothing.",
    at="messages.LampRead.fields",
    before=("lamp_id:\n  type: u8\n  notes: [{text: Lamp 0 is on the board., cite: manual}]"),
    after=("lamp_id:\n  type: u8"),
    look=_look,
)
