"""Rule: the frame of a look-alike is made of parts that fit together."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import checksum_problems, part_problems
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import ConstantPart

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Frame, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for key, lookalike in spec.lookalikes.items():
        if lookalike.frame is None:
            continue
        path = ("lookalikes", key, "frame")
        problems = [
            *part_problems(path, lookalike.frame),
            *checksum_problems(path, lookalike.frame),
        ]
        yield from problems or _recognisable(path, lookalike.frame)


def _recognisable(path: KeyPath, frame: Frame) -> Iterator[Problem]:
    """Refuse what a library could not recognise: it looks for simple frames alone."""
    first = next(iter(frame.values()))
    if not isinstance(first, ConstantPart):
        what = "a look-alike is looked for by the constant with which its frames begin"
        yield Problem(path, what, "leave out its `frame`, and say in `about` how to tell it")
    for kind in ("length", "id"):
        if not any(part.is_ == kind for part in frame.values()):
            what = f"a look-alike is recognised by the {kind} of its frames, and they have none"
            yield Problem(path, what, "leave out its `frame`, and say in `about` how to tell it")


RULE = StructureRule(
    id="lookalike-frame",
    title="The frame of a look-alike is made of parts that fit together",
    why="A look-alike is recognised by the parts of its frame, above all by length and checksum.",
    bad="frame: {header: ..., parameters: ..., length: ...}",
    good="frame: {header: ..., length: ..., parameters: ..., checksum: ...}",
    look=_look,
)
