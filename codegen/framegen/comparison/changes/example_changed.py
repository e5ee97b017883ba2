"""Change: an example has other bytes or other values."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.changes.wording import called
from framegen.language.values import to_hex

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.examples.twins:
        old, new = to_hex(each.old.hex), to_hex(each.new.hex)
        yield from changed("example-changed", each, "hex", old, new, "bytes")
        values = both.values_called(str(each.old_path[1]), each.old.values)
        if repr(values) != repr(each.new.values):
            text = f"{called(each.new_path)}: has other values"
            paths = (*each.old_path, "values"), (*each.new_path, "values")
            yield Change("example-changed", *paths, text)
        old, new = each.old.constructed, each.new.constructed
        yield from changed("example-changed", each, "constructed", old, new, "constructed:")


RULE = ChangeRule(
    id="example-changed",
    title="An example has other bytes or other values",
    subject="document",
    why="A frame that was published or captured does not change: what is read from it does.",
    do="Where a document or a device gave it, find out why it does not hold any more.",
    at="messages.LampRead",
    before=(
        "examples:\n  - {title: Lamp 1, hex: AA 55 02 08 01, values: {lamp_id: 1}, cite: manual}"
    ),
    after=(
        "examples:\n  - {title: Lamp 1, hex: AA 55 02 08 02, values: {lamp_id: 2}, cite: manual}"
    ),
    look=_look,
)
