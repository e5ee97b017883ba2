"""Rule: every list says how many elements it has, or what says so."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import frame_of
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import LengthPart, ListField
from framegen.model.layout import is_varying

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Frame, NumberField, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        frame = frame_of(spec, message)
        if frame is None:
            continue
        for field_name, field in message.fields.items():
            here = ("messages", name, "fields", field_name)
            if not is_varying(field):
                yield from _fixed(here, field_name, field, frame)


def _fixed(
    path: KeyPath, name: str, field: ListField | NumberField, frame: Frame
) -> Iterator[Problem]:
    count = field.count
    if count is None:
        if isinstance(field, ListField):
            what = f"nothing says how many elements `{name}` has"
            yield Problem(path, what, f"add {_choices(frame)}, or `count: 4` if always 4", True)
    elif count.low != count.high:
        what = f"nothing says how many `{name}` has: `count: {count}` only bounds it"
        here = (*path, "count")
        yield Problem(here, what, f"add {_choices(frame)}, or give one number, such as 16", True)


def _choices(frame: Frame) -> str:
    """Return what can say how many there are."""
    lengths = [name for name, part in frame.items() if isinstance(part, LengthPart)]
    left = f"`sized_by: {lengths[0]}` for all that is left of the frame, or " if lengths else ""
    return f"{left}`counted_by` with the earlier field that counts it"


RULE = StructureRule(
    id="list-size",
    title="Every list says how many elements it has, or what says so",
    why="A decoder must know where a list ends: after a number of elements that never changes, or "
    "where an earlier field or the length of the frame says.",
    bad="lamps: {type: u8, count: 1..}",
    good="lamps: {type: u8, count: 4}",
    look=_look,
)
