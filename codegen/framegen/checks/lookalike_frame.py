"""Rule: the frame of a look-alike is made of parts that fit together."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from framegen.checks.frames import part_problems
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import ChecksumPart

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for key, lookalike in spec.lookalikes.items():
        if lookalike.frame is None:
            continue
        path = ("lookalikes", key, "frame")
        yield from part_problems(path, lookalike.frame)
        names = list(lookalike.frame)
        for name, after in pairwise(names):
            if isinstance(lookalike.frame[name], ChecksumPart):
                yield Problem(
                    (*path, after),
                    f"`{after}` stands after the checksum",
                    "the checksum ends the frame",
                    on_key=True,
                )


RULE = StructureRule(
    id="lookalike-frame",
    title="The frame of a look-alike is made of parts that fit together",
    why="A look-alike is recognised by the parts of its frame, above all by length and checksum.",
    bad="frame: {header: ..., checksum: ..., parameters: ...}",
    good="frame: {header: ..., length: ..., command: ..., parameters: ..., checksum: ...}",
    look=_look,
)
