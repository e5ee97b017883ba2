"""Change: the length of a frame counts other parts."""

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
        old, new = (getattr(one, "counts", []) for one in (each.old, each.new))
        before, after = both.parts_called(each, old), ", ".join(new)
        yield from changed("length-counts", each, "counts", before, after, "counts")


RULE = ChangeRule(
    id="length-counts",
    title="The length of a frame counts other parts",
    subject="frame",
    why="An end that counts otherwise waits for more bytes than come, or stops too early.",
    do="Change both ends at once.",
    at="frame",
    before="length: {is: length, type: u8, counts: [command, parameters]}",
    after="length: {is: length, type: u8, counts: [length, command, parameters]}",
    look=_look,
)
