"""Change: the library has another name."""

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
    yield from changed(
        "library-renamed", protocol, "name", protocol.old.name, protocol.new.name, "library"
    )


RULE = ChangeRule(
    id="library-renamed",
    title="The library has another name",
    subject="program",
    why="Programs import the library by the name of the protocol.",
    do=(
        "Change the imports of all programs; they can name both for a while: `import new_name as "
        "old_name`."
    ),
    at="protocol",
    before="name: lamps",
    after="name: bright_lamps",
    look=_look,
)
