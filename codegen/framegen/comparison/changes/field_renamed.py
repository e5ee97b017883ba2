"""Change: a field has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import renamed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from renamed("field-renamed", both.fields)


RULE = ChangeRule(
    id="field-renamed",
    title="A field has another name",
    subject="field",
    why="Programs name it as an argument and an attribute. On the wire, nothing changes.",
    do=(
        "Change it together with another break of programs. `was` says that it is the same, as "
        "long as anybody compares with the old name."
    ),
    at="messages.LampRead.fields",
    before="lamp_id: {type: u8}",
    after="number: {type: u8, was: lamp_id}",
    look=_look,
)
