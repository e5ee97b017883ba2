"""Change: other devices are said to take other values."""

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
        old, new = ({} if one.limits is None else one.limits.others for one in (each.old, each.new))
        before, after = (
            ", ".join(f"{name} {bounds}" for name, bounds in others.items())
            for others in (old, new)
        )
        yield from changed("other-limits", each, "limits", before, after, "limits of others,")


RULE = ChangeRule(
    id="other-limits",
    title="Other devices are said to take other values",
    subject="document",
    why="Pages and errors tell of them. Nothing depends on it.",
    do="Nothing.",
    at="messages.LampRead.fields",
    before=("lamp_id:\n  type: u8\n  limits: {usual: 0..100}"),
    after=("lamp_id:\n  type: u8\n  limits: {usual: 0..100, others: {Lamp mini: 0..50}}"),
    look=_look,
)
