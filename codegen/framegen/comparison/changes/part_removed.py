"""Change: frames lost a part."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("part-removed", both.parts, lambda each: str(each.what.is_))


RULE = ChangeRule(
    id="part-removed",
    title="Frames lost a part",
    subject="frame",
    why=(
        "Every frame of the new edition is shorter than one of the old, and neither end reads the "
        "frames of the other."
    ),
    do="Change both ends at once, or add a kind of frame beside the old one.",
    at="frame",
    before="check: {is: checksum, type: u8, method: sum, covers: [command, parameters]}",
    after="",
    look=_look,
)
