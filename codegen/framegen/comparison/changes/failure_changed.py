"""Change: another field of a reply, or value of it, says that a request has failed."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        old = each.old.failure
        if old is not None:
            named = both.field(str(each.old_path[1]), old.field)
            old = replace(old, field=named or old.field)
        yield from changed("failure-changed", each, "failure", old, each.new.failure, "failure")


RULE = ChangeRule(
    id="failure-changed",
    title="Another field of a reply says that a request has failed, or another value",
    subject="exchange",
    why=(
        "A client raises an error where this field is not zero, or has not the value that is "
        "named as the good one. Otherwise it returns the reply as if all were well."
    ),
    do="Tell the authors of programs: where they looked at the field, they now catch an error.",
    at="messages.LampState",
    before="",
    after="failure: level",
    look=_look,
)
