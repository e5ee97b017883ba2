"""Change: a part of the frame has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import called

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.parts.twins:
        if each.is_renamed:
            text = f"{called(each.new_path)}: renamed from {each.old_path[-1]}"
            yield Change("part-renamed", each.old_path, each.new_path, text)


RULE = ChangeRule(
    id="part-renamed",
    title="A part of the frame has another name",
    subject="frame",
    why=(
        "Names of an address, a running number and ids are arguments or constants of the library. "
        "Nobody sees the name of any other part."
    ),
    do=(
        "Where programs name it, change it together with another break of programs; `was` says "
        "that it is the same."
    ),
    at="frame",
    before="station: {is: address, type: u8}",
    after="device: {is: address, type: u8, was: station}",
    look=_look,
)
