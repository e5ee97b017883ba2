"""Rule: a field does not have the name of a part of the frame that a user gives."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import frame_of
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import AddressPart, CounterPart, LengthPart

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        frame = frame_of(spec, message) or {}
        sizes = {field.sized_by for field in message.fields.values()}
        for field in message.fields:
            part = frame.get(field)
            given = isinstance(part, AddressPart | CounterPart)
            if part is not None and (given or (isinstance(part, LengthPart) and field in sizes)):
                there = (
                    ("frames", spec.frame_of(message), field) if spec.frames else ("frame", field)
                )
                what = f"`{field}` is the {part.is_} of the frame as well as a field of {name}"
                hint = "rename one: both are values of the message"
                if isinstance(part, LengthPart):
                    hint = "rename one: `sized_by` could mean either"
                here = ("messages", name, "fields", field)
                yield Problem(here, what, hint, True, (there, "the part is here"))


RULE = StructureRule(
    id="part-name",
    title="A field does not have the name of a part of the frame that a user gives",
    why="The address and the running number of a frame are values of every message: of two values "
    "with one name, one would be lost.",
    bad="frame: {lamp: {is: address, ...}, ...}  # and a field `lamp`",
    good="frame: {station: {is: address, ...}, ...}  # and a field `lamp`",
    look=_look,
)
