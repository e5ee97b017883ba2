"""Rule: no two messages of one direction can have the same frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.model.apart import alike, shared_size, told_by_checksum

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


def _look(model: Model) -> Iterator[Problem]:
    for one, other in alike(model):
        size = shared_size(one, other)
        if size is not None and not told_by_checksum(one, other):
            yield _problem(one, other, size)


def _problem(one: MessageLayout, other: MessageLayout, size: int) -> Problem:
    named = f"{one.name} and {other.name}"
    if other.message.id is None:
        what = f"{named} both go {other.direction}, with frames of {size} bytes"
        path: KeyPath = ("messages", other.name)
        also = (("messages", one.name), "the first is here")
        tells = "an id, a constant (`always`), another `range` or another size"
        hint = f"only {tells} could tell them apart"
        return Problem(path, what, hint, on_key=True, also=also)
    what = f"{named} are both {other.message.id}, {other.direction}"
    if _sizes_vary(one, other):
        what += f", and both can have {size} bytes"
    if one.message.id != other.message.id:
        what = f"{named} can have the same bytes, {other.direction}"
    path, first = ("messages", other.name, "id"), ("messages", one.name, "id")
    hint = (
        "mend one of the codes, or the direction; where both are right, only an `always`, a "
        "`range` or a size tells them apart"
    )
    return Problem(path, what, hint, also=(first, f"{one.name} has it first"))


def _sizes_vary(*messages: MessageLayout) -> bool:
    return any(message.least != message.largest for message in messages)


RULE = ModelRule(
    id="duplicate-id",
    title="No two messages of one direction can have the same frame",
    why="A receiver tells a message by its direction, by the constants and ids of its frame, and "
    "by its size: where all of these agree, nobody can say which was meant. An id that is not sent "
    "tells them apart only if the checksum that covers it is never the same.",
    bad="{LampOn: {id: 7, direction: host -> lamp}, LampOff: {id: 7, direction: host -> lamp}}",
    good="{LampOn: {id: 7, direction: host -> lamp}, LampOff: {id: 8, direction: host -> lamp}}",
    look=_look,
)
