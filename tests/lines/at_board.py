"""A virtual board in virtual time, and a client of it: a read moves its clock on."""

from types import SimpleNamespace
from typing import Any

from busservo_simulator import VirtualClock, VirtualController


def virtual_board(**given: Any) -> VirtualController:
    """Return a board in this process, whose time goes on when somebody waits for it."""
    return VirtualController(**{"clock": VirtualClock(follow_reads=True), **given})


def end_of(board: Any) -> Any:
    """Return the end of its line where it is read and written, with its clock."""
    end = board.transport
    return SimpleNamespace(read=end.read, write=end.write, close=end.close, clock=board.clock.now)


def received_by(board: Any) -> list[Any]:
    """Return what a board understands from now on, as it comes."""
    received: list[Any] = []
    accepted = board.board.accepted

    def noted(message: Any) -> None:
        received.append(message)
        accepted(message)

    board.board.accepted = noted
    return received


def client_at(board: Any, kind: type, **given: Any) -> Any:
    """Return a client of that kind on the time of its board, at which it need not wait first."""
    settings = {"background": False, "clock": board.clock.now, "settle": 0, **given}
    return kind(board.transport, **settings)
