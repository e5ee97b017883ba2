"""A virtual board in virtual time, and a client of it: a read moves its clock on."""

from __future__ import annotations

from typing import Any

from busservo_simulator import VirtualClock, VirtualController


def virtual_board(**given: Any) -> VirtualController:
    """Return a board in this process, whose time goes on when somebody waits for it."""
    return VirtualController(**{"clock": VirtualClock(follow_reads=True), **given})


def client_at(board: Any, kind: type, **given: Any) -> Any:
    """Return a client of that kind on the time of its board, at which it need not wait first."""
    settings = {"background": False, "clock": board.clock.now, "settle": 0, **given}
    return kind(board.transport, **settings)
