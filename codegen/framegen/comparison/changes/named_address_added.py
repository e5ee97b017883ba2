"""Change: an address has a name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("named-address-added", both.addresses, lambda each: str(each.what.value))


RULE = ChangeRule(
    id="named-address-added",
    title="An address has a name",
    subject="frame",
    why=(
        "The library has a constant for it; where it lies outside the range, ends of the old "
        "edition refuse it."
    ),
    do="Nothing.",
    at="frame",
    before=("station:\n  is: address\n  type: u8\n  range: 1..32"),
    after=(
        "station:\n"
        "  is: address\n"
        "  type: u8\n"
        "  range: 1..32\n"
        "  values: {all: {value: 254, silent: true}}"
    ),
    look=_look,
)
