"""Rule: the bytes of a list are counted by an earlier number, or by the length of the frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.counters import counter_problems, plain_before
from framegen.checks.frames import frame_of
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import LengthPart
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Frame, Message, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        frame = frame_of(spec, message)
        if frame is None:
            continue
        for field_name, field in message.fields.items():
            if field.sized_by is not None:
                here = ("messages", name, "fields", field_name, "sized_by")
                yield from _size(here, name, message, field_name, field.sized_by, frame)


def _size(
    path: KeyPath, name: str, message: Message, field_name: str, size: str, frame: Frame
) -> Iterator[Problem]:
    lengths = [part for part, each in frame.items() if isinstance(each, LengthPart)]
    if size in message.fields:
        yield from counter_problems(path, name, message, field_name, size, lengths)
    elif size in frame and size not in lengths:
        what = f"`{size}` is no length: it is the {frame[size].is_} of the frame"
        yield Problem(path, what, _way_out(message, field_name, lengths))
    elif size not in lengths:
        what = f"{name} has no field `{size}`, and its frame has no length part of that name"
        if not lengths:
            what = f"{name} has no field `{size}`, and its frame has no length part"
        way_out = _way_out(message, field_name, lengths)
        known = [*lengths, *plain_before(message, field_name)]
        yield Problem(path, what, did_you_mean(size, known, otherwise=way_out))


def _way_out(message: Message, field_name: str, lengths: list[str]) -> str:
    known = [*lengths, *plain_before(message, field_name)]
    if lengths:
        return f"write `sized_by: {known[0]}` for all that the frame has left"
    if known:
        return f"write `sized_by: {known[-1]}`, if that says how many bytes follow"
    return (
        "nothing in front says how long it is: give it a fixed size, such as `count: 16`, or "
        "describe each size as a message of its own"
    )


RULE = StructureRule(
    id="sized-by",
    title="The bytes of a list are counted by an earlier number, or by the length of the frame",
    why="A decoder must know where a list ends. `sized_by` names what counts its bytes, where "
    "`counted_by` names what counts its elements; where it is the length part of the frame, the "
    "list is all that is left.",
    bad="{data: {type: u8, sized_by: length}}  # in a frame without a part `length`",
    good="{size: {type: u8}, data: {type: u8, sized_by: size}}",
    look=_look,
)
