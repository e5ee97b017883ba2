"""Rule: reserved ids and names are not used."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for index, reserved in enumerate(spec.reserved):
        path: KeyPath = ("reserved", index)
        if reserved.id is None and reserved.name is None:
            yield Problem(path, "nothing is reserved here", "give an `id`, a `name`, or both")
        for name, message in spec.messages.items():
            ways = (None, message.direction)
            if message.id == reserved.id and reserved.direction in ways:
                yield Problem(
                    ("messages", name, "id"),
                    f"the id {message.id} is reserved: {reserved.why}",
                    "choose another code",
                    also=((*path, "id"), "it is reserved here"),
                )
            if name == reserved.name:
                yield Problem(
                    ("messages", name),
                    f"the name `{name}` is reserved: {reserved.why}",
                    "choose another name",
                    on_key=True,
                    also=((*path, "name"), "it is reserved here"),
                )


RULE = StructureRule(
    id="reserved",
    title="Reserved ids and names are not used",
    why="Devices and programs in use still know the former meaning of an id or a name.",
    bad="reserved: [{id: 7, why: It was LampFade until 2.0.}]  # and a message with the id 7",
    good="reserved: [{id: 7, why: It was LampFade until 2.0.}]  # and no message with that id",
    look=_look,
)
