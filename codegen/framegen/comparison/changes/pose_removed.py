"""Change: positions are not read and commanded as poses any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    if both.old.pose is not None and both.new.pose is None:
        text = f"pose is gone: {both.old.pose.hold}, {both.old.pose.present}"
        yield Change("pose-removed", ("pose",), None, text)


RULE = ChangeRule(
    id="pose-removed",
    title="Positions are not read and commanded as poses any more",
    subject="program",
    why="The methods of the client are gone, and so are the verbs `stop`, `hold`, `teach` and "
    "`play`.",
    do="Keep it while programs use them.",
    at="",
    before=(
        "pose:\n"
        "  read: LampsRead\n"
        "  move: LampsFade\n"
        "  release: LampsOff\n"
        "  ids: 1..8\n"
        "  hold: hold_lamps\n"
        "  present: present_lamps\n"
        "  targets: lamp_targets"
    ),
    after="",
    look=_look,
)
