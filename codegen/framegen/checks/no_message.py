"""Rule: a spec has messages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    if not spec.messages:
        yield Problem(("messages",), "there is no message here", "describe at least one")


RULE = StructureRule(
    id="no-message",
    title="A spec has messages",
    why="A library without messages helps nobody.",
    bad="messages: {}",
    good="messages: {LampOff: {id: 2, direction: host -> lamp, ...}}",
    look=_look,
)
