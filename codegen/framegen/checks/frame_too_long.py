"""Rule: the length and the count can say how long every legal frame is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks import count_bounds, counted_by, empty_group, frame_parts, unknown_type
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import GroupField, NumberField
from framegen.language.wiretypes import WIRE_TYPES
from framegen.model.layout import derive_frame

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import AnyField, Message, Spec
    from framegen.model.layout import FrameLayout
    from framegen.reading.yamltree import KeyPath

# Without these there is no size to reckon with.
_FIRST = (unknown_type, frame_parts, counted_by, count_bounds, empty_group)


def _look(spec: Spec) -> Iterator[Problem]:
    if any(True for rule in _FIRST for _ in rule.RULE.look(spec)):
        return
    frame = derive_frame(spec)
    for name, message in spec.messages.items():
        yield from _in_message(("messages", name), name, message, frame)


def _in_message(
    path: KeyPath, name: str, message: Message, frame: FrameLayout
) -> Iterator[Problem]:
    fixed = frame.counted + sum(
        _size(field) for field in message.fields.values() if field.counted_by is None
    )
    most = frame.length.high
    if fixed > most:
        yield Problem(
            path,
            f"{name} needs a {frame.length_name} of {fixed}, "
            f"and a {frame.length.name} ends at {most}",
            on_key=True,
        )
        return
    for field_name, field in message.fields.items():
        if field.counted_by is not None and field.count is not None:
            count = field.count
            room, limit = _room(message, field, most - fixed, frame)
            over = max(count.low, count.high or 0)
            if over > room:
                yield Problem(
                    (*path, "fields", field_name, "count"),
                    f"{over} elements are too many: {limit} has room for {room}",
                    f"write {count.low}.. for as many as there is room for"
                    if count.low <= room
                    else "",
                )


def _room(message: Message, field: AnyField, rest: int, frame: FrameLayout) -> tuple[int, str]:
    """Reckon how many elements there is room for, and what limits them."""
    by_length = rest // _size(field)
    counter = message.fields[field.counted_by or ""]
    by_count = WIRE_TYPES[counter.type].high if isinstance(counter, NumberField) else 0
    if by_count < by_length:
        return by_count, f"`{field.counted_by}`"
    return by_length, f"`{frame.length_name}`"


def _size(field: AnyField) -> int:
    """Bytes of a number, or of one element."""
    if isinstance(field, GroupField):
        return sum(_size(inner) for inner in field.fields.values())
    return WIRE_TYPES[field.type].size


RULE = StructureRule(
    id="frame-too-long",
    title="The length and the count can say how long every legal frame is",
    why="A frame whose length does not fit cannot be sent, and to cut it in silence is worse.",
    bad="count: 1..300  # where the length is a u8",
    good="count: 1..",
    look=_look,
)
