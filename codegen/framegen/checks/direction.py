"""Rule: every direction leads from one endpoint to another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.language.values import Direction
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for path, direction in _directions(spec):
        for name in dict.fromkeys((direction.sender, direction.receiver)):
            if name not in spec.endpoints:
                hint = did_you_mean(name, spec.endpoints)
                yield Problem(path, f"there is no endpoint `{name}`", hint)
        if direction.sender == direction.receiver:
            yield Problem(path, f"`{direction.sender}` cannot send to itself")


def _directions(spec: Spec) -> Iterator[tuple[KeyPath, Direction]]:
    for name, message in spec.messages.items():
        yield ("messages", name, "direction"), message.direction
    for index, reserved in enumerate(spec.reserved):
        if reserved.direction is not None:
            yield ("reserved", index, "direction"), reserved.direction


RULE = StructureRule(
    id="direction",
    title="Every direction leads from one endpoint to another",
    why="The direction identifies a message together with its id; a misspelt one makes it another "
    "message.",
    bad="direction: hots -> lamp",
    good="direction: host -> lamp",
    look=_look,
)
