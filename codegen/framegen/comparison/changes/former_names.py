"""Change: something is said to have had another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for twin in both.everything():
        old, new = (set(getattr(one, "was", ())) for one in (twin.old, twin.new))
        if twin.is_renamed and old ^ new <= {twin.old_path[-1], twin.new_path[-1]}:
            continue
        before, after = (", ".join(getattr(one, "was", ())) for one in (twin.old, twin.new))
        yield from changed("former-names", twin, "was", before, after, "called before")


RULE = ChangeRule(
    id="former-names",
    title="Something is said to have had another name",
    subject="document",
    why="It is how a comparison knows a thing again under its new name.",
    do="Keep it as long as anybody compares with an edition that has the old name.",
    at="messages.LampRead",
    before="",
    after="was: LampAsk",
    look=_look,
)
