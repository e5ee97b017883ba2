"""Rule: the frame of a look-alike is made of parts that fit together."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import checksum_problems, part_problems
from framegen.checks.rule import StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.checks.rule import Problem
    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for key, lookalike in spec.lookalikes.items():
        if lookalike.frame is None:
            continue
        path = ("lookalikes", key, "frame")
        yield from part_problems(path, lookalike.frame)
        yield from checksum_problems(path, lookalike.frame)


RULE = StructureRule(
    id="lookalike-frame",
    title="The frame of a look-alike is made of parts that fit together",
    why="A look-alike is recognised by the parts of its frame, above all by length and checksum.",
    bad="frame: {header: ..., parameters: ..., length: ...}",
    good="frame: {header: ..., length: ..., parameters: ..., checksum: ...}",
    look=_look,
)
