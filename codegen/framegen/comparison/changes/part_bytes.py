"""Change: the constant bytes of a frame are others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.language.values import to_hex

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.parts.twins:
        old, new = (to_hex(getattr(one, "bytes_", b"")) for one in (each.old, each.new))
        yield from changed("part-bytes", each, "bytes", old, new)


RULE = ChangeRule(
    id="part-bytes",
    title="The constant bytes of a frame are others",
    subject="frame",
    why=(
        "A frame is found by its constant bytes: with others it is noise. Reserved bytes are only "
        "written otherwise."
    ),
    do="Change both ends at once.",
    at="frame",
    before="header: {is: constant, bytes: AA 55}",
    after="header: {is: constant, bytes: AA 66}",
    look=_look,
)
