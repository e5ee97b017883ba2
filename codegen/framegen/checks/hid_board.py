"""Rule: each USB HID board is described once, and its reports have room for a frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks import frame_parts, unknown_type
from framegen.checks.rule import Problem, StructureRule
from framegen.model.envelope import derive_envelope

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    first: dict[str, int] = {}
    for at, board in enumerate(spec.link.usb_hid):
        if first.setdefault(board.ids, at) != at:
            yield Problem(
                ("link", "usb_hid", at, "product"),
                f"the board {board.ids} is described twice",
                also=(("link", "usb_hid", first[board.ids], "product"), "the first is here"),
            )
    if any(True for rule in (unknown_type, frame_parts) for _ in rule.RULE.look(spec)):
        return
    order = spec.byte_order
    least = min(derive_envelope(frame, order).least for frame in spec.envelopes.values())
    for at, board in enumerate(spec.link.usb_hid):
        if board.report_size < least:
            yield Problem(
                ("link", "usb_hid", at, "report_size"),
                f"no frame fits into {board.report_size} bytes: the shortest has {least}",
                "a report of USB HID mostly has 64",
            )


RULE = StructureRule(
    id="hid-board",
    title="Each USB HID board is described once, and its reports have room for a frame",
    why="A board is found by its vendor and product, and each of its reports carries one frame.",
    bad="usb_hid: [{vendor: 0x0483, product: 0x5750, report_size: 2}]",
    good="usb_hid: [{vendor: 0x0483, product: 0x5750, report_size: 64}]",
    look=_look,
)
