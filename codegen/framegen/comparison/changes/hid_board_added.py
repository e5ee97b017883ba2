"""Change: another board is found by USB HID."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import added

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from added("hid-board-added", both.boards, lambda each: str(each.what.ids))


RULE = ChangeRule(
    id="hid-board-added",
    title="Another board is found by USB HID",
    subject="line",
    why="A library looks for boards by vendor and product. Older libraries do not find this one.",
    do="Nothing: what was found before still is.",
    at="link",
    before="",
    after=("usb_hid:\n  - {vendor: 0x0483, product: 0x5750}"),
    look=_look,
)
