"""Change: devices have other addresses."""

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
        old, new = (getattr(one, "range", None) for one in (each.old, each.new))
        yield from changed("address-range", each, "range", old, new, "range")


RULE = ChangeRule(
    id="address-range",
    title="Devices have other addresses",
    subject="frame",
    why="An end refuses a frame to an address that it does not know of.",
    do="Let the range only grow.",
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
        "  range: 1..16\n"
        "  values: {all: {value: 254, silent: true}}"
    ),
    look=_look,
)
