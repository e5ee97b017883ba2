"""Change: a character has other bits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    link = both.part_of("link")
    for key in ("data_bits", "parity", "stop_bits"):
        old, new = getattr(link.old, key), getattr(link.new, key)
        yield from changed("character-format", link, key, old, new, key.replace("_", " "))


RULE = ChangeRule(
    id="character-format",
    title="A character has other bits",
    subject="line",
    why=(
        "Data bits, parity and stop bits are agreed on by both ends: otherwise bytes arrive "
        "changed, or with errors."
    ),
    do="Change both ends at once.",
    at="link",
    before="baud: 9600",
    after=("baud: 9600\nparity: even"),
    look=_look,
)
