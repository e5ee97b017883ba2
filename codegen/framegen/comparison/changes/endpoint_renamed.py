"""Change: an end of the line has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import renamed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from renamed("endpoint-renamed", both.ends)


RULE = ChangeRule(
    id="endpoint-renamed",
    title="An end of the line has another name",
    subject="program",
    why=("Directions of the library are named for the ends. On the wire, nobody sees the name."),
    do="Change it together with another break of programs.",
    at="",
    before="endpoints: {host: Commands., lamp: Shines., switch: Reports.}",
    after="endpoints: {host: Commands., lamp: Shines., button: Reports.}",
    look=_look,
)
