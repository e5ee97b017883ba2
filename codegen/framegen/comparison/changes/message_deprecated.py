"""Change: a message is deprecated, or not any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import called

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        old, new = each.old.deprecated, each.new.deprecated
        if old != new:
            said = f"is deprecated now: {new}" if new else "is not deprecated any more"
            paths = (*each.old_path, "deprecated"), (*each.new_path, "deprecated")
            yield Change("message-deprecated", *paths, f"{called(each.new_path)} {said}")


RULE = ChangeRule(
    id="message-deprecated",
    title="A message is deprecated, or not any more",
    subject="program",
    why="The library warns whoever sends a deprecated message. Nothing on the wire changes.",
    do="Its reason says what to use instead. Remove it no earlier than with the next break.",
    at="messages.LampRead",
    before="",
    after="deprecated: LampsRead asks for all at once.",
    look=_look,
)
