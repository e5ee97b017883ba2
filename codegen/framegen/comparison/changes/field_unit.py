"""Change: the steps of a number are said otherwise."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.units import quantity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.numbers:
        same = quantity(each.old) == quantity(each.new)
        for key in ("unit", "scale"):
            old, new = getattr(each.old, key), getattr(each.new, key)
            for one in changed("field-unit", each, key, old, new, key):
                yield replace(one, text=f"{one.text}, and means the same") if same else one


RULE = ChangeRule(
    id="field-unit",
    title="The steps of a number are said otherwise",
    subject="field",
    why=(
        "The same number means another quantity to the other end. Written down for the first "
        "time, or spelt otherwise, it means the same."
    ),
    do=(
        "Where the meaning changes, add a field or a message: no end can tell which is meant. "
        "Where an uncertain unit is only spelt otherwise, say so in `breaks` of the `history`."
    ),
    at="messages.LampRead.fields",
    before="time: {type: u16, unit: ms}",
    after="time: {type: u16, unit: s}",
    look=_look,
)
