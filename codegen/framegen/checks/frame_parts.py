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
    why="A decoder needs a constant to search for, one length that counts the body, and one id "
    "that says what the body holds.",
    bad="frame: {length: ..., header: ..., parameters: ...}",
    good="frame: {header: ..., length: ..., command: ..., parameters: ...}",
    look=_look,
)
