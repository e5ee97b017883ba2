"""Change: a named address has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import renamed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from renamed("named-address-renamed", both.addresses)


RULE = ChangeRule(
    id="named-address-renamed",
    title="A named address has another name",
    subject="frame",
    why="The constant of the library has another name.",
    do="Change it together with another break of programs.",
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
        "  values: {every: {value: 254, was: all, silent: true}}"
    ),
    look=_look,
)
