"""Rule: something in a frame shows where it begins."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import envelopes
from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for path, frame in envelopes(spec):
        kinds = {part.is_ for part in frame.values()}
        if kinds & {"constant", "checksum"} or {"id", "length"} <= kinds or "body" not in kinds:
            continue
        lacks = " and ".join(sorted({"id", "length"} - kinds))
        yield Problem(
            path,
            f"nothing shows where a frame begins: it has no constant, no checksum and no {lacks}",
            "say which bytes are always the same, such as `header: {is: constant, bytes: AA 55}`, "
            "or which are a checksum, `{is: checksum, ...}`; frames that silence alone divides "
            "cannot be described",
        )


RULE = StructureRule(
    id="findable-frame",
    title="Something in a frame shows where it begins",
    why="A decoder may begin to listen at any byte. Where every byte can begin a frame, it would "
    "find frames everywhere, and none of them could be believed.",
    bad="frame: {command: {is: id, type: u8}, parameters: {is: body}}",
    good="frame: {header: {is: constant, bytes: AA}, command: ..., parameters: ...}",
    look=_look,
)
