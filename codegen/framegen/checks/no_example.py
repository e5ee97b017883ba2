"""Rule: every message has an example."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from framegen.checks.pasted import lowest, pasted
from framegen.checks.rule import ModelRule, Problem

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    for name, message in model.messages.items():
        if not message.message.examples:
            yield Problem(
                ("messages", name),
                f"{name} has no example",
                partial(_hint, message),
                on_key=True,
            )


def _hint(message: MessageLayout) -> str:
    example = pasted(message, lowest(message), "A short title")
    what = "give a frame with its source, or one that was `constructed`"
    return f"{what}, such as {example}" if example else what


RULE = ModelRule(
    id="no-example",
    title="Every message has an example",
    why="Without a frame to try it on, nothing shows that the layout of a message is right.",
    bad="LampOff: {id: 2, ...}",
    good="LampOff: {id: 2, ..., examples: [{title: Off, hex: AA 55 01 02, values: {}, ...}]}",
    look=_look,
)
