"""Rule: the frame is described, once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec

_WHOLE = (
    "list its parts in order, such as frame: {header: {is: constant, bytes: AA 55}, "
    "length: {is: length, type: u8, counts: [command, parameters]}, "
    "command: {is: id, type: u8}, parameters: {is: body}}"
)


def _look(spec: Spec) -> Iterator[Problem]:
    if spec.frame and spec.frames:
        what = "the frame is described twice, by `frame` and by `frames`"
        hint = "keep `frame` if all messages have the same one, and `frames` if not"
        yield Problem(("frames",), what, hint, True, (("frame",), "`frame` is here"))
    elif not spec.frame and not spec.frames:
        yield Problem(("frame",), "the key `frame` is missing, or empty", _WHOLE, on_key=True)


RULE = StructureRule(
    id="one-frame",
    title="The frame is described, once",
    why="A library needs to know what is around the fields of a message. One `frame` serves all "
    "messages; where directions or families of messages differ in theirs, `frames` has each by "
    "name.",
    bad="frame: {}",
    good="frame: {header: ..., length: ..., command: ..., parameters: ...}",
    look=_look,
)
