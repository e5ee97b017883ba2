"""Change: a checksum covers other parts."""

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
        old, new = (getattr(one, "covers", []) for one in (each.old, each.new))
        before, after = both.parts_called(each, old), ", ".join(new)
        yield from changed("checksum-covers", each, "covers", before, after, "covers")


RULE = ChangeRule(
    id="checksum-covers",
    title="A checksum covers other parts",
    subject="frame",
    why="Each end refuses what the other sends, for a wrong checksum.",
    do="Change both ends at once.",
    at="frame",
    before="check: {is: checksum, type: u8, method: sum, covers: [command, parameters]}",
    after="check: {is: checksum, type: u8, method: sum, covers: [length, command, parameters]}",
    look=_look,
)
