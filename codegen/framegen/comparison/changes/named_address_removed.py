"""Change: an address has no name any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("named-address-removed", both.addresses, lambda each: str(each.what.value))


RULE = ChangeRule(
    id="named-address-removed",
    title="An address has no name any more",
    subject="frame",
    why=(
        "The constant of the library is gone; where it lies outside the range, ends of the new "
        "edition refuse it."
    ),
    do="Keep the name, and say in `about` that it is not used any more.",
    at="frame",
    before=(
        "station:\n"
        "  is: address\n"
        "  type: u8\n"
        "  range: 1..32\n"
        "  values: {all: {value: 254, silent: true}}"
    ),
    after=("station:\n  is: address\n  type: u8\n  range: 1..32"),
    look=_look,
)
