"""Change: a bit has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import renamed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from renamed("bit-renamed", both.bits)


RULE = ChangeRule(
    id="bit-renamed",
    title="A bit has another name",
    subject="value",
    why="The property of the library has another name.",
    do="Change it together with another break of programs. `was` says that it is the same.",
    at="messages.LampRead.fields",
    before="state: {type: u8, bits: {hot: 0}}",
    after="state: {type: u8, bits: {warm: {at: 0, was: hot}}}",
    look=_look,
)
