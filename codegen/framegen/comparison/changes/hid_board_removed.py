"""Change: a board is not found by USB HID any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import removed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from removed("hid-board-removed", both.boards, lambda each: str(each.what.ids))


RULE = ChangeRule(
    id="hid-board-removed",
    title="A board is not found by USB HID any more",
    subject="line",
    why="A library looks for boards by vendor and product, and passes by this one from now on.",
    do="Keep it as long as anybody has one.",
    at="link",
    before=("usb_hid:\n  - {vendor: 0x0483, product: 0x5750}"),
    after="",
    look=_look,
)
