"""Change: poses are read or commanded otherwise."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.changes.things import Twin

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    old, new = both.old.pose, both.new.pose
    if old is None or new is None:
        return
    twin = Twin(("pose",), ("pose",), old, new)
    for key in type(new).model_fields:
        before, after = getattr(old, key), getattr(new, key)
        if key in ("read", "move", "release"):
            before = both.message(before)
        yield from changed("pose-changed", twin, key, before, after, key)


RULE = ChangeRule(
    id="pose-changed",
    title="Poses are read or commanded otherwise",
    subject="program",
    why="Programs call these methods by name, and the numbers outside `ids` are not looked for.",
    do="Keep the names, and let `ids` only grow.",
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
    after=(
        "pose:\n"
        "  read: LampsRead\n"
        "  move: LampsFade\n"
        "  release: LampsOff\n"
        "  ids: 1..8\n"
        "  hold: keep_lamps\n"
        "  present: present_lamps\n"
        "  targets: lamp_targets"
    ),
    look=_look,
)
