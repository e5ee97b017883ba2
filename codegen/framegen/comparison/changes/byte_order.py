"""Change: the bytes of numbers come in another order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.changes.things import Twin

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    twin = Twin((), (), both.old, both.new)
    before, after = both.old.byte_order, both.new.byte_order
    yield from changed("byte-order", twin, "byte_order", before, after, "byte order")
    for each in both.parts.twins:
        orders = getattr(each.old, "byte_order", None), getattr(each.new, "byte_order", None)
        yield from changed("byte-order", each, "byte_order", *orders, "byte order")


RULE = ChangeRule(
    id="byte-order",
    title="The bytes of numbers come in another order",
    subject="frame",
    why=(
        "Each number of two bytes and more is read with its bytes turned round: 1 becomes 256, if "
        "it has two."
    ),
    do="Change both ends at once; where only one field is meant, give that field a `byte_order`.",
    at="",
    before="byte_order: little",
    after="byte_order: big",
    look=_look,
)
