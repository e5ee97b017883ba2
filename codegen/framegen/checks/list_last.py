"""Rule: a list of a size that varies ends its message."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.model.layout import is_varying

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        path = ("messages", name, "fields")
        lists = [key for key, field in message.fields.items() if is_varying(field)]
        if not lists:
            continue
        names = list(message.fields)
        for after in names[names.index(lists[0]) + 1 :]:
            yield Problem(
                (*path, after),
                f"`{after}` stands after the list `{lists[0]}`",
                "a list ends its message, and is its only one",
                on_key=True,
                also=((*path, lists[0]), "the list is here"),
            )


RULE = StructureRule(
    id="list-last",
    title="A message has at most one list whose size varies, and it ends the message",
    why="Then every other field has a fixed place, and the count follows from the length. Lists of "
    "a fixed size may stand anywhere.",
    bad="fields: {lamp_count: ..., lamps: ..., fade_ms: ...}",
    good="fields: {lamp_count: ..., fade_ms: ..., lamps: ...}",
    look=_look,
)
