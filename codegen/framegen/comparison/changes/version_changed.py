"""Change: the spec has another version."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    protocol = both.part_of("protocol")
    versions = protocol.old.version, protocol.new.version
    yield from changed("version-changed", protocol, "version", *versions, "version")


RULE = ChangeRule(
    id="version-changed",
    title="The spec has another version",
    subject="document",
    why="It is what users compare their library by.",
    do="Raise it by what the comparison says that is due.",
    at="protocol",
    before='version: "1.0.0"',
    after='version: "1.1.0"',
    look=_look,
)
