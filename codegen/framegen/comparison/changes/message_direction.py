"""Change: a message goes from another end, or to another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.language.values import Direction

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        old = each.old.direction
        ends = both.pair.ends
        way = Direction(ends.get(old.sender, old.sender), ends.get(old.receiver, old.receiver))
        yield from changed("message-direction", each, "direction", way, each.new.direction)


RULE = ChangeRule(
    id="message-direction",
    title="A message goes from another end, or to another",
    subject="message",
    why=(
        "The end that should receive it now does not know it, and the library has it on the other "
        "side."
    ),
    do="Add a message in the new direction, and deprecate the old one.",
    at="messages.LampsSet",
    before="direction: host -> lamp",
    after="direction: lamp -> host",
    look=_look,
)
