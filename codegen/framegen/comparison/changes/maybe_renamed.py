"""Change: something may have another name."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING, Any

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import called
from framegen.reading.yamltree import dotted

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.things import Things


def _look(both: Both) -> Iterator[Change]:
    kinds: tuple[Things[Any], ...] = (
        both.messages,
        both.fields,
        both.values,
        both.bits,
        both.addresses,
    )
    for each in chain.from_iterable(kind.twins for kind in kinds):
        if each.guessed:
            old, new = each.old_path[-1], called(each.new_path)
            what = f"{new}: may be another name of {old}"
            text = f"{what}; if it is, write `was: {old}` below `{dotted(each.new_path)}`"
            yield Change("maybe-renamed", each.old_path, each.new_path, text)


RULE = ChangeRule(
    id="maybe-renamed",
    title="Something may have another name",
    subject="message",
    why=(
        "A name is gone, and another came in its place. Whether it means the same, no frame can "
        "tell."
    ),
    do=(
        "Where it is the same, write `was: old_name`. Where it is not, accept the break in "
        "`history`."
    ),
    at="messages.LampRead.fields",
    before="lamp_id: {type: u8}",
    after="number: {type: u8}",
    look=_look,
)
