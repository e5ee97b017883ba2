"""Rule: the frame is made of parts that fit together."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import envelopes, part_problems
from framegen.checks.rule import StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.checks.rule import Problem
    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for path, frame in envelopes(spec):
        yield from part_problems(path, frame)


RULE = StructureRule(
    id="frame-parts",
    title="The frame is made of parts that fit together",
    why="A decoder reads from front to back: it must know the id and the length before the body, "
    "and where the body ends.",
    bad="frame: {header: ..., parameters: {is: body}, command: {is: id, type: u8}}",
    good="frame: {header: ..., command: {is: id, type: u8}, parameters: {is: body}}",
    look=_look,
)
