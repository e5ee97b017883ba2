"""Change: a list of bytes is text, or not any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.numbers:
        yield from changed("text", each, "text", each.old.text, each.new.text, "text")


RULE = ChangeRule(
    id="text",
    title="A list of bytes is text, or not any more",
    subject="field",
    why="Programs give and get text instead of numbers; bytes that are no text are refused.",
    do="Change it together with another break of programs.",
    at="messages.LampRead.fields",
    before="name: {type: u8, count: 8}",
    after="name: {type: u8, count: 8, text: ascii}",
    look=_look,
)
