"""Change: there is another note."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("note-added", both.notes)


RULE = ChangeRule(
    id="note-added",
    title="There is another note",
    subject="document",
    why="A note is a fact that no codec enforces.",
    do="Read it: what it says may matter to programs.",
    at="messages.LampRead.fields",
    before=("lamp_id:\n  type: u8"),
    after=("lamp_id:\n  type: u8\n  notes: [{text: Lamp 0 is on the board., cite: manual}]"),
    look=_look,
)
