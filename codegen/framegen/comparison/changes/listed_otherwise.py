"""Change: something is listed in another order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import moved

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    own = (both.ends, both.parts, both.messages, both.fields)
    for kind in both.kinds():
        if kind not in own:
            yield from moved("listed-otherwise", kind)


RULE = ChangeRule(
    id="listed-otherwise",
    title="Something is listed in another order",
    subject="document",
    why="Pages and constants follow the order of the spec. Nothing depends on it.",
    do="Nothing.",
    at="messages.LampRead.fields",
    before="time: {type: u16, values: {at_once: {value: 0}, never: {value: 9}}}",
    after="time: {type: u16, values: {never: {value: 9}, at_once: {value: 0}}}",
    look=_look,
)
