"""Rule: every example of a look-alike is recognised as one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.explain.lookalikes import recognise

from framegen.checks.rule import ModelRule, Problem

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    for name, lookalike in model.spec.lookalikes.items():
        for index, example in enumerate(lookalike.examples):
            path = ("lookalikes", name, "examples", index, "hex")
            found = recognise(model.protocol, example.hex)
            if found is None:
                text = f"this is no frame of {lookalike.title}"
                yield Problem(path, text, "check its length, its checksum and its ids")
            elif found.name != name:
                yield Problem(path, f"this is a frame of {found.lookalike.title}")


RULE = ModelRule(
    id="lookalike-example",
    title="Every example of a look-alike is recognised as one",
    why="People paste such frames to learn why nothing answers them: they must be recognised.",
    bad="hex: AA 55 01 03 07 00  # with a wrong checksum",
    good="hex: AA 55 01 03 07 F4",
    look=_look,
)
