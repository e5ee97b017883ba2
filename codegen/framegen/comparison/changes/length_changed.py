"""Change: a message has another length rule."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import became, called
from framegen.language.formula import Formula

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        was = each.old.length
        if isinstance(was, Formula) and was.name is not None:
            was = replace(was, name=both.field(str(each.old_path[1]), was.name))
        if was != each.new.length:
            text = f"{called(each.new_path)}: {became('length', was, each.new.length)}"
            yield Change(
                "length-changed", (*each.old_path, "length"), (*each.new_path, "length"), text
            )


RULE = ChangeRule(
    id="length-changed",
    title="A message has another length rule",
    subject="message",
    why="Frames of lengths that an end does not expect are refused.",
    do="Look at which fields changed: the rule follows from them.",
    at="messages.LampRead",
    before=(
        "length: [2, 3, 4]\n"
        "fields:\n"
        "  lamp_id: {type: u8}\n"
        "  colour: {type: u8, optional: true}\n"
        "  time: {type: u8, optional: true}"
    ),
    after=(
        "length: [2, 4]\n"
        "fields:\n"
        "  lamp_id: {type: u8}\n"
        "  colour: {type: u8, optional: true}\n"
        "  time: {type: u8, optional: true}"
    ),
    look=_look,
)
