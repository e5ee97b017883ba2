"""Rule: the frame is made of parts that fit together."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from framegen.checks.frames import part_problems
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import BodyPart, ConstantPart

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


_NOT_YET = {
    "address": (
        "frames with an address cannot be described yet",
        "if it is always the same, make it a constant",
    ),
    "checksum": ("frames with a checksum cannot be described yet", ""),
}


def _look(spec: Spec) -> Iterator[Problem]:
    yield from part_problems(("frame",), spec.frame)
    yield from _order(spec)
    for name, part in spec.frame.items():
        if part.is_ in _NOT_YET:
            yield Problem(("frame", name), *_NOT_YET[part.is_], on_key=True)


def _order(spec: Spec) -> Iterator[Problem]:
    in_header = True
    for name, part in spec.frame.items():
        constant = isinstance(part, ConstantPart)
        if constant and not in_header:
            yield Problem(
                ("frame", name),
                f"the constant `{name}` stands after other parts",
                "constants begin the frame",
                on_key=True,
            )
        in_header = in_header and constant
    names = list(spec.frame)
    if names and not isinstance(spec.frame[names[0]], ConstantPart):
        yield Problem(
            ("frame", names[0]),
            "the frame does not begin with a constant",
            "a stream is searched for the constant: put it first",
            on_key=True,
        )
    for name, after in pairwise(names):
        if isinstance(spec.frame[name], BodyPart) and spec.frame[after].is_ not in _NOT_YET:
            yield Problem(
                ("frame", after),
                f"`{after}` stands after the body",
                "the body ends the frame",
                on_key=True,
            )


RULE = StructureRule(
    id="frame-parts",
    title="The frame is made of parts that fit together",
    why="A decoder needs a constant to search for, one length that counts the body, and one id "
    "that says what the body holds.",
    bad="frame: {length: ..., header: ..., parameters: ...}",
    good="frame: {header: ..., length: ..., command: ..., parameters: ...}",
    look=_look,
)
