"""Rule: no frame begins with another that nothing shows to be over."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.model.apart import begun, shared_size

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    for short, long in begun(model):
        if shared_size(short, long) is not None or (short.frame.proven and long.frame.proven):
            continue
        names = {short.name, long.name}
        first, second = (name for name in model.messages if name in names)
        hint = (
            "if the two differ in a byte, make it an `id`, or give it an `always` or a `range` in "
            "each; else describe one of them alone"
        )
        if short.frame.proven:
            what = f"one of {short.name} can begin a frame of {long.name}, {long.direction}"
            what += ", which no checksum proves: with what follows it would be taken for that"
            hint = f"if a part of {long.name} is a checksum, say so; {hint}"
        else:
            what = f"a frame of {long.name}, {long.direction}, can begin with one of {short.name}"
            what += ", and would be taken for it"
            hint = f"if a part of {short.name} is its length or a checksum, say so; {hint}"
        also = (("messages", first), "the other is here")
        yield Problem(("messages", second), what, hint, on_key=True, also=also)


RULE = ModelRule(
    id="frame-prefix",
    title="No frame begins with another that nothing shows to be over",
    why="Bytes come one after the other: where neither a length nor checksums tell the two apart, "
    "what follows a shorter frame makes a longer one of it. Silence would decide it on some lines, "
    "and no operating system reports silence reliably.",
    bad="{LampOn: {id: 7, length: 2}, LampFade: {id: 7, length: 4}}  # without a length part",
    good="{LampOn: {id: 7, length: 2}, LampFade: {id: 8, length: 4}}",
    look=_look,
)
