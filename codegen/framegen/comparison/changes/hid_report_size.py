"""Change: the reports of a board by USB HID have another size."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    for each in both.boards.twins:
        old, new = each.old.report_size, each.new.report_size
        yield from changed("hid-report-size", each, "report_size", old, new, "report size")


RULE = ChangeRule(
    id="hid-report-size",
    title="The reports of a board by USB HID have another size",
    subject="line",
    why=(
        "Each report carries one frame and is padded to this size: one of another size is refused "
        "by the system or by the board."
    ),
    do="Change it only where it was wrong: it is a fact of the board.",
    at="link",
    before=("usb_hid:\n  - {vendor: 0x0483, product: 0x5750}"),
    after=("usb_hid:\n  - {vendor: 0x0483, product: 0x5750, report_size: 32}"),
    look=_look,
)
