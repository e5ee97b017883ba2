"""Change: the parts of the frame come in another order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import moved

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from moved("part-order", both.parts)


RULE = ChangeRule(
    id="part-order",
    title="The parts of the frame come in another order",
    subject="frame",
    why="Each end looks for a part where the other has a different one.",
    do="Change both ends at once.",
    at="",
    before=(
        "frame:\n"
        "  header: {is: constant, bytes: AA 55}\n"
        "  length: {is: length, type: u8, counts: [command, parameters]}\n"
        "  command: {is: id, type: u8}\n"
        "  parameters: {is: body}"
    ),
    after=(
        "frame:\n"
        "  header: {is: constant, bytes: AA 55}\n"
        "  command: {is: id, type: u8}\n"
        "  length: {is: length, type: u8, counts: [command, parameters]}\n"
        "  parameters: {is: body}"
    ),
    look=_look,
)
