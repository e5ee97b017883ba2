"""Change: a client sends other values unless told otherwise."""

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
        old, new = (
            None if one.limits is None else one.limits.usual for one in (each.old, each.new)
        )
        yield from changed("field-limits", each, "limits", old, new, "limits")


RULE = ChangeRule(
    id="field-limits",
    title="A client sends other values unless told otherwise",
    subject="program",
    why=(
        "A program that sends a value outside the limits is refused by its own library. On the "
        "wire, nothing changes."
    ),
    do="Tell the authors of programs how to go beyond them.",
    at="messages.LampRead.fields",
    before="lamp_id: {type: u8}",
    after="lamp_id: {type: u8, limits: {usual: 0..100}}",
    look=_look,
)
