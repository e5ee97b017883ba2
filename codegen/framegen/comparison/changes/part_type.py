"""Change: a part of the frame has another number type."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.parts.twins:
        old, new = getattr(each.old, "type", None), getattr(each.new, "type", None)
        yield from changed("part-type", each, "type", old, new)


RULE = ChangeRule(
    id="part-type",
    title="A part of the frame has another number type",
    subject="frame",
    why="A part of another size moves all that is behind it.",
    do="Change both ends at once.",
    at="frame",
    before="length: {is: length, type: u8, counts: [command, parameters]}",
    after="length: {is: length, type: u16, counts: [command, parameters]}",
    look=_look,
)
