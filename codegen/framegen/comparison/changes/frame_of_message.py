"""Change: a message has another kind of frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.changes.telling import changed
from framegen.comparison.changes.wording import called

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both


def _look(both: Both) -> Iterator[Change]:
    for each in both.messages.twins:
        was, now = both.old.frame_of(each.old), both.new.frame_of(each.new)
        was = both.pair.frames.to_new.get(was, was)
        if was != now:
            yield from changed("frame-of-message", each, "frame", was, now, "frame")
        elif (each.old.frame is None) != (each.new.frame is None):
            text = f"{called(each.new_path)}: frame {now} as before, named or not"
            yield Change(
                "frame-of-message", (*each.old_path, "frame"), (*each.new_path, "frame"), text
            )


RULE = ChangeRule(
    id="frame-of-message",
    title="A message has another kind of frame",
    subject="message",
    why="An end looks for it in the frame that it had, and takes the other for noise.",
    do="Add a message in the new frame, and deprecate the old one.",
    at="",
    before=(
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
        "    parameters: {is: body}\n"
        "messages:\n"
        "  LampState:\n"
        "    frame: report"
    ),
    look=_look,
)
