"""Change: somebody answers at an address, or nobody does any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import switched

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.addresses.twins:
        words = ("is not silent any more", "is silent now")
        yield from switched(
            "silent-address", each, "silent", each.old.silent, each.new.silent, words
        )


RULE = ChangeRule(
    id="silent-address",
    title="Somebody answers at an address, or nobody does any more",
    subject="exchange",
    why=(
        "A client waits for a reply from every address that is not silent, and gives up after its "
        "timeout."
    ),
    do="Change both ends at once.",
    at="frame",
    before=(
        "station:\n"
        "  is: address\n"
        "  type: u8\n"
        "  range: 1..32\n"
        "  values: {all: {value: 254, silent: true}}"
    ),
    after=("station:\n  is: address\n  type: u8\n  range: 1..32\n  values: {all: {value: 254}}"),
    look=_look,
)
