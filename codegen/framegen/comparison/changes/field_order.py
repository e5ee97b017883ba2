"""Change: fields come in another order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import moved

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from moved("field-order", both.fields)


RULE = ChangeRule(
    id="field-order",
    title="Fields come in another order",
    subject="field",
    why="Each end reads the value of one field as that of another, and nothing tells it so.",
    do="Turn them back, or add a message.",
    at="messages.LampRead",
    before="fields: {lamp_id: {type: u8}, colour: {type: u8}}",
    after="fields: {colour: {type: u8}, lamp_id: {type: u8}}",
    look=_look,
)
