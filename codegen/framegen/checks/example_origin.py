"""Rule: every example says where it comes from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        for index, example in enumerate(message.examples):
            path = ("messages", name, "examples", index)
            if example.cite is None and not example.constructed:
                yield Problem(
                    path,
                    "nothing says where this frame comes from",
                    "add `cite`, or `constructed` if it was made up",
                )
            elif example.cite is not None and example.constructed:
                yield Problem(
                    (*path, "constructed"),
                    "a frame is either cited or made up, not both",
                    "remove `constructed`, or `cite`",
                    on_key=True,
                )


RULE = StructureRule(
    id="example-origin",
    title="Every example says where it comes from",
    why="A published or captured frame is evidence; an invented one is not, and must not pass for "
    "it.",
    bad="{title: Off, hex: AA 55 01 02}",
    good="{title: Off, hex: AA 55 01 02, cite: vendor, section 1}",
    look=_look,
)
