"""Change: an id is sent that was not, or the other way round."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import switched

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.parts.twins:
        old, new = (getattr(one, "sent", True) for one in (each.old, each.new))
        yield from switched(
            "id-sent", each, "sent", old, new, ("is not sent any more", "is sent now")
        )


RULE = ChangeRule(
    id="id-sent",
    title="An id is sent that was not, or the other way round",
    subject="frame",
    why="Frames are longer or shorter by an id, and neither end reads the frames of the other.",
    do="Change both ends at once.",
    at="",
    before=(
        "frame:\n"
        "  header: {is: constant, bytes: AA 55}\n"
        "  length: {is: length, type: u8, counts: [command, parameters]}\n"
        "  command: {is: id, type: u8}\n"
        "  kind: {is: id, type: u8, sent: false}\n"
        "  parameters: {is: body}\n"
        "  check: {is: checksum, type: u8, method: sum, covers: [kind, command]}\n"
        "messages:\n"
        "  LampRead:\n"
        "    id: {command: 8, kind: 1}\n"
        "    fields: {lamp_id: {type: u8}}"
    ),
    after=(
        "frame:\n"
        "  header: {is: constant, bytes: AA 55}\n"
        "  length: {is: length, type: u8, counts: [command, parameters]}\n"
        "  command: {is: id, type: u8}\n"
        "  kind: {is: id, type: u8}\n"
        "  parameters: {is: body}\n"
        "  check: {is: checksum, type: u8, method: sum, covers: [kind, command]}\n"
        "messages:\n"
        "  LampRead:\n"
        "    id: {command: 8, kind: 1}\n"
        "    fields: {lamp_id: {type: u8}}"
    ),
    look=_look,
)
