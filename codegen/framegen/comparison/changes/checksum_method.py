"""Change: a checksum is worked out by another method."""

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
        old, new = (getattr(one, "method", "") for one in (each.old, each.new))
        yield from changed("checksum-method", each, "method", old, new, "method")


RULE = ChangeRule(
    id="checksum-method",
    title="A checksum is worked out by another method",
    subject="frame",
    why="Each end refuses what the other sends, for a wrong checksum.",
    do="Change both ends at once.",
    at="frame",
    before="check: {is: checksum, type: u8, method: sum, covers: [command, parameters]}",
    after="check: {is: checksum, type: u8, method: xor, covers: [command, parameters]}",
    look=_look,
)
