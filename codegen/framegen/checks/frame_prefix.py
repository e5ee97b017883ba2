"""Rule: no frame begins with another that nothing shows to be over."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.apart import alike, shared_size
from framegen.checks.rule import ModelRule, Problem

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    for one, other in alike(model):
        short, long = sorted((one, other), key=lambda message: message.least)
        is_told = short.frame.proven or (one.frame is other.frame and one.frame.length_part)
        if shared_size(one, other) is None and not is_told:
            yield Problem(
                ("messages", other.name),
                f"a frame of {long.name}, {other.direction}, can begin with one of {short.name}, "
                "and would be taken for it",
                f"if a part of {short.name} is its length or a checksum, say so; if the two differ "
                "in a byte, make it an `id`, or give it an `always` or a `range` in each; else "
                "describe one of them alone",
                on_key=True,
                also=(("messages", one.name), "the other is here"),
            )


RULE = ModelRule(
    id="frame-prefix",
    title="No frame begins with another that nothing shows to be over",
    why="Bytes come one after the other: where neither a length nor a checksum tells it from the "
    "longer one, the shorter frame is taken as soon as it is there. Silence would decide it on "
    "some lines, and no operating system reports silence reliably.",
    bad="{LampOn: {id: 7, length: 2}, LampFade: {id: 7, length: 4}}  # without a length part",
    good="{LampOn: {id: 7, length: 2}, LampFade: {id: 8, length: 4}}",
    look=_look,
)
