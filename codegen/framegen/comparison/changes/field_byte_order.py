"""Change: the bytes of a field come in another order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.numbers:
        old, new = each.old.byte_order, each.new.byte_order
        yield from changed("field-byte-order", each, "byte_order", old, new, "byte order")


RULE = ChangeRule(
    id="field-byte-order",
    title="The bytes of a field come in another order",
    subject="field",
    why="Its number is read with its bytes turned round.",
    do="Add a message, or change both ends at once.",
    at="messages.LampRead.fields",
    before="time: {type: u16, byte_order: big}",
    after="time: {type: u16, byte_order: little}",
    look=_look,
)
