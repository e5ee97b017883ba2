"""Change: a number can be read as another signed type, or not any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.numbers:
        old, new = each.old.signed_as, each.new.signed_as
        yield from changed("signed-as-changed", each, "signed_as", old, new, "signed as")


RULE = ChangeRule(
    id="signed-as-changed",
    title="A number can be read as another signed type, or not any more",
    subject="program",
    why=("The library has a property for it, and for programs that use it the number has a sign."),
    do="Keep it while programs use the property.",
    at="messages.LampRead.fields",
    before="lamp_id: {type: u16}",
    after="lamp_id: {type: u16, signed_as: i16}",
    look=_look,
)
