"""The board behind a pty, behind TCP and in the same process: the same board every time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from busservo import ServoMove
from busservo_simulator import VirtualController

from tests.in_turn import in_turn
from tests.unit.runtime.simulator.conftest import ASK, VOLTAGE, host_at

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.lines.hosts import Host

    Connect = Callable[..., tuple[Any, Host]]


def test_a_fast_writer_is_slowed_to_the_line(connect: Connect) -> None:
    board, host = connect(baud=921600)
    host.say(*[ServoMove(0, [(1, 500)])] * 500)
    assert host.ask(ASK) == VOLTAGE
    assert (board.accepted, board.rejects.total) == (501, 0)


def test_a_port_can_be_opened_again(connect: Connect) -> None:
    board, host = connect()
    for _ in range(3):
        host.hang_up()
        host = host_at(board)
        assert host.ask(ASK) == VOLTAGE
    host.hang_up()
    # Nor is it an error to unplug or close it twice.
    for end in (board.unplug, board.close):
        end()
        end()


def test_a_board_elsewhere_has_no_transport_here() -> None:
    with VirtualController("tcp") as board, pytest.raises(ValueError, match="open that"):
        _ = board.transport


@in_turn(
    "given, said",
    lambda: [
        ({"via": "usb"}, "via is 'usb': it is 'memory', 'pty' or 'tcp'"),
        ({"baud": 0}, "baud is 0: it is above 0, or None for a line that is not paced"),
    ],
)
def test_what_is_no_line_is_refused(given: dict[str, Any], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        VirtualController(**given)
