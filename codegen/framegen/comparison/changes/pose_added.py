"""Change: positions are read and commanded as poses."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    if both.old.pose is None and both.new.pose is not None:
        text = f"pose is new: {both.new.pose.hold}, {both.new.pose.present}"
        yield Change("pose-added", None, ("pose",), text)


RULE = ChangeRule(
    id="pose-added",
    title="Positions are read and commanded as poses",
    subject="program",
    why="The client has more methods, and the command has the verbs `stop`, `hold`, `teach` and "
    "`play`.",
    do="Nothing.",
    at="",
    before="",
    after=(
        "pose:\n"
        "  read: LampsRead\n"
        "  move: LampsFade\n"
        "  release: LampsOff\n"
        "  ids: 1..8\n"
        "  hold: hold_lamps\n"
        "  present: present_lamps\n"
        "  targets: lamp_targets"
    ),
    look=_look,
)
