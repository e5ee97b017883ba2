"""Change: a kind of frame has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.wording import called

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.frames.twins:
        if each.old_path != each.new_path:
            text = f"{called(each.new_path)}: renamed from {called(each.old_path)}"
            yield Change("frame-renamed", each.old_path, each.new_path, text)


RULE = ChangeRule(
    id="frame-renamed",
    title="A kind of frame has another name",
    subject="document",
    why="Nobody sees the name of a kind of frame: it is the same by its parts.",
    do="Nothing.",
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
        "  order:\n"
        "    header: {is: constant, bytes: AA 55}\n"
        "    length: {is: length, type: u8, counts: [command, parameters]}\n"
        "    command: {is: id, type: u8}\n"
        "    parameters: {is: body}"
    ),
    look=_look,
)
