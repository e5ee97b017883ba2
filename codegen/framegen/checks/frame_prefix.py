"""Rule: no frame is the beginning of another, where nothing in it says where it ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.apart import alike, shared_size
from framegen.checks.rule import ModelRule, Problem

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    for one, other in alike(model):
        if shared_size(one, other) is None and _unsaid(one) and _unsaid(other):
            short, long = sorted((one, other), key=lambda message: message.least)
            yield Problem(
                ("messages", other.name),
                f"a frame of {short.name} can be the beginning of one of {long.name}, "
                f"{other.direction}, and only silence would tell them apart",
                "if a part of the frame is its length or a checksum, say so; if the two differ in "
                "a byte, make it an `id`, or give it an `always` or a `range` in each; else "
                "describe one of them alone",
                on_key=True,
                also=(("messages", one.name), "the other is here"),
            )


def _unsaid(message: MessageLayout) -> bool:
    """Tell whether nothing in a frame shows that it is over."""
    return message.frame.length_part is None and not message.frame.proven


RULE = ModelRule(
    id="frame-prefix",
    title="No frame is the beginning of another, where nothing in it says where it ends",
    why="Bytes come one after the other: without a length and without a checksum, whoever has the "
    "shorter frame cannot know whether the longer one is still coming. Silence decides that on "
    "some lines, and no operating system reports silence reliably.",
    bad="{LampOn: {id: 7, length: 2}, LampFade: {id: 7, length: 4}}  # without a length part",
    good="{LampOn: {id: 7, length: 2}, LampFade: {id: 8, length: 4}}",
    look=_look,
)
