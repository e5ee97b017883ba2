"""Rule: what a version breaks on purpose is named by its path, with the reason."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.paths import NoPath, expect_place, read_path
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath

_EXAMPLE = "write it as findings have it, such as `messages.NAME.fields.NAME`"


def _look(spec: Spec) -> Iterator[Problem]:
    for index, release in enumerate(spec.history):
        for text, reason in release.breaks.items():
            here = ("history", index, "breaks", text)
            yield from _path(here, text)
            if not reason.strip():
                what = f"nothing says why `{text}` breaks"
                yield Problem(here, what, "write the reason, for those whose program it breaks")


def _path(here: KeyPath, text: str) -> Iterator[Problem]:
    try:
        path = read_path(text)
        expect_place(path)
    except NoPath as error:
        hint = did_you_mean(error.step, error.known) if error.known else _EXAMPLE
        yield Problem(here, str(error), hint, on_key=True)
        return
    if path == ("messages",):
        what = "`messages` would accept whatever breaks in any of them"
        yield Problem(here, what, "name one, such as `messages.NAME`", on_key=True)


RULE = StructureRule(
    id="breaks",
    title="What a version breaks on purpose is named by its path, with the reason",
    why="`framegen diff` accepts a break at that path and below it; a path that leads nowhere "
    "accepts nothing, and a break without a reason looks like a mistake.",
    bad='history: [{version: "2.0.0", breaks: {LampFade: ""}, ...}]',
    good='history: [{version: "2.0.0", breaks: {messages.LampFade: No board has it.}, ...}]',
    look=_look,
)
