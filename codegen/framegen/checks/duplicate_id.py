"""Rule: no two messages have the same id in the same direction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.notation import Ids
    from framegen.language.spec import Spec
    from framegen.language.values import Direction


def _look(spec: Spec) -> Iterator[Problem]:
    first: dict[tuple[Direction, str, Ids | None], str] = {}
    for name, message in spec.messages.items():
        key = message.direction, spec.frame_of(message), message.id
        other = first.setdefault(key, name)
        if other != name and message.id is not None:
            yield Problem(
                ("messages", name, "id"),
                f"{other} and {name} are both {message.id}, {message.direction}",
                "mend one of the codes, or the direction",
                also=(("messages", other, "id"), f"{other} has it first"),
            )


RULE = StructureRule(
    id="duplicate-id",
    title="No two messages have the same id in the same direction",
    why="A receiver identifies a message by its direction and its id alone.",
    bad="{LampOn: {id: 7, direction: host -> lamp}, LampOff: {id: 7, direction: host -> lamp}}",
    good="{LampOn: {id: 7, direction: host -> lamp}, LampOff: {id: 8, direction: host -> lamp}}",
    look=_look,
)
