"""Rule: only the last numbers of a message may be absent."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import frame_of
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import LengthPart, ListField
from framegen.model.layout import is_list

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import AnyField, Message, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        path: KeyPath = ("messages", name, "fields")
        optional = [key for key, field in message.fields.items() if _is_optional(field)]
        for key, field in message.fields.items():
            if isinstance(field, ListField):
                for inner, each in field.fields.items():
                    if each.optional:
                        here = (*path, key, "fields", inner, "optional")
                        what = f"`{inner}` is inside an element, all of which have the same size"
                        yield Problem(here, what, "leave out `optional`", on_key=True)
        if not optional:
            continue
        frame = frame_of(spec, message)
        if frame is not None and not any(isinstance(each, LengthPart) for each in frame.values()):
            yield Problem(
                (*path, optional[0], "optional"),
                f"nothing in the frame of {name} tells whether `{optional[0]}` is there",
                "describe the longer frame as a message of its own, if a checksum or an id tells "
                "the two apart; else leave out `optional`",
                on_key=True,
            )
        yield from _last(path, message, optional)


def _last(path: KeyPath, message: Message, optional: list[str]) -> Iterator[Problem]:
    names = list(message.fields)
    for name in names[names.index(optional[0]) :]:
        field = message.fields[name]
        if name in optional and (is_list(field) or getattr(field, "text", None)):
            what = f"`{name}` is no number, and only numbers can be absent"
            hint = "write `sized_by`, with the length part of the frame, and `count: 0..`"
            yield Problem((*path, name, "optional"), what, hint, on_key=True)
        elif name not in optional:
            what = f"`{name}` stands behind `{optional[0]}`, which may be absent"
            also = ((*path, optional[0]), "it is here")
            hint = "add `optional: true`, or leave it out there"
            yield Problem((*path, name), what, hint, True, also)


def _is_optional(field: AnyField) -> bool:
    return not isinstance(field, ListField) and field.optional


RULE = StructureRule(
    id="optional-last",
    title="Only the last numbers of a message may be absent",
    why="The length of the frame is all that shows how many fields there are: a field in the "
    "middle would leave its place to the next one.",
    bad="{level: {type: u8, optional: true}, fade_ms: {type: u16}}",
    good="{level: {type: u8}, fade_ms: {type: u16, optional: true}}",
    look=_look,
)
