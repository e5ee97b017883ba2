"""Rule: every id fits the part of the frame that carries it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import IdPart

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for part_name, part in spec.frame.items():
        type_ = NUMBER_TYPES.get(part.type) if isinstance(part, IdPart) else None
        if type_ is None:
            continue
        for path, code in _codes(spec):
            if code > type_.high:
                yield Problem(
                    path,
                    f"{code} does not fit `{part_name}`, a {type_.name}: it ends at {type_.high}",
                )


def _codes(spec: Spec) -> Iterator[tuple[KeyPath, int]]:
    for name, message in spec.messages.items():
        yield ("messages", name, "id"), message.id
    for index, reserved in enumerate(spec.reserved):
        if reserved.id is not None:
            yield ("reserved", index, "id"), reserved.id


RULE = StructureRule(
    id="id-range",
    title="Every id fits the part of the frame that carries it",
    why="An id that is too large would be cut, and the frame taken for another message.",
    bad="id: 300  # where `command` is a u8",
    good="id: 30",
    look=_look,
)
