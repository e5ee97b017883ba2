"""Rule: a checksum has a known method, and covers other parts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import checksum_problems, envelopes
from framegen.checks.rule import StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.checks.rule import Problem
    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for path, frame in envelopes(spec):
        yield from checksum_problems(path, frame)


RULE = StructureRule(
    id="checksum",
    title="A checksum has a known method, and covers other parts",
    why="The catalogue has each method with its published check value. Both ends work it out from "
    "the same bytes, so these have names, and no checksum is among its own.",
    bad="{is: checksum, type: u8, method: crc-16/modbus, covers: [length, parameters]}",
    good="{is: checksum, type: u16, method: crc-16/modbus, covers: [length, parameters]}",
    look=_look,
)
