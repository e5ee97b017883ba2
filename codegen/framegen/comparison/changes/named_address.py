"""Change: a named address is another number."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.addresses.twins:
        yield from changed("named-address", each, "value", each.old.value, each.new.value)


RULE = ChangeRule(
    id="named-address",
    title="A named address is another number",
    subject="frame",
    why="What one end sends to all, the other takes for a device.",
    do="Change both ends at once, or give the new number a name of its own.",
    at="frame",
    before=(
        "station:\n"
        "  is: address\n"
        "  type: u8\n"
        "  range: 1..32\n"
        "  values: {all: {value: 254, silent: true}}"
    ),
    after=(
        "station:\n"
        "  is: address\n"
        "  type: u8\n"
        "  range: 1..32\n"
        "  values: {all: {value: 255, silent: true}}"
    ),
    look=_look,
)
