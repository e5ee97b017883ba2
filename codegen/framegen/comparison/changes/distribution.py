"""Change: the distribution of the library is said otherwise."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    protocol = both.part_of("protocol")
    old, new = protocol.old.distribution, protocol.new.distribution
    if old != new:
        text = "protocol: its distribution is described otherwise"
        path = ("protocol", "distribution")
        yield Change("distribution", path, path, text)


RULE = ChangeRule(
    id="distribution",
    title="The distribution of the library is said otherwise",
    subject="document",
    why=(
        "Licence and authors are in the project file of a library that is a distribution of its "
        "own."
    ),
    do="Nothing.",
    at="protocol",
    before="distribution: {license: MIT}",
    after="distribution: {license: MIT, authors: [Ada]}",
    look=_look,
)
