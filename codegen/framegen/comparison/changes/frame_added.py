"""Change: there is another kind of frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("frame-added", both.frames)


RULE = ChangeRule(
    id="frame-added",
    title="There is another kind of frame",
    subject="frame",
    why="Ends of the old edition take it for noise.",
    do="Nothing, as long as nothing that was sent before is sent in it.",
    at="",
    before=(
        "frames:\n"
        "  command:\n"
        "    header: {is: constant, bytes: AA 55}\n"
        "    length: {is: length, type: u8, counts: [command, parameters]}\n"
        "    command: {is: id, type: u8}\n"
        "    parameters: {is: body}"
    ),
    after=(
        "frames:\n"
        "  command:\n"
        "    header: {is: constant, bytes: AA 55}\n"
        "    length: {is: length, type: u8, counts: [command, parameters]}\n"
        "    command: {is: id, type: u8}\n"
        "    parameters: {is: body}\n"
        "  report:\n"
        "    header: {is: constant, bytes: AA 66}\n"
        "    length: {is: length, type: u8, counts: [command, parameters]}\n"
        "    command: {is: id, type: u8}\n"
        "    parameters: {is: body}"
    ),
    look=_look,
)
