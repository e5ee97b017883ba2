"""An adapter that returns what the host sends: in front of the board's answers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from busservo import ActionGroupStop, BatteryVoltage, BatteryVoltageRead, ServoMove
from busservo_simulator import Board, Faults
from framewire.simulator.line import Line

from tests.lines.at_board import virtual_board
from tests.lines.hosts import Host, host_of

if TYPE_CHECKING:
    from collections.abc import Callable

ASK = BatteryVoltageRead().encode()
REPLY = BatteryVoltage(7500).encode()
MOVE = ServoMove(0, [(1, 500)]).encode()


def test_what_is_sent_comes_back_and_then_the_reply(
    connect: Callable[..., tuple[Any, Host]],
) -> None:
    board, host = connect(local_echo=True)
    host.transport.write(ASK)
    assert host.collect(len(ASK + REPLY)) == ASK + REPLY
    host.transport.write(MOVE)
    host.transport.write(ASK)
    assert host.collect(len(MOVE + ASK + REPLY)) == MOVE + ASK + REPLY
    assert (board.accepted, board.rejects.total) == (3, 0)


@pytest.mark.garbage
def test_what_is_no_frame_comes_back_as_well(connect: Callable[..., tuple[Any, Host]]) -> None:
    _, host = connect(local_echo=True)
    host.transport.write(b"\x00\x55")
    assert host.collect(2) == b"\x00\x55"


def test_an_echo_is_paced_as_what_is_sent() -> None:
    with virtual_board(baud=9600, local_echo=True) as board:
        host = host_of(board)
        host.transport.write(MOVE)
        assert host.collect(10) == MOVE
        assert board.clock.now() == pytest.approx(10 / 960)
        host.transport.write(ASK)
        assert host.collect(10) == ASK + REPLY
        assert board.clock.now() == pytest.approx(20 / 960)


def test_it_is_the_adapter_that_echoes_whatever_the_board_does() -> None:
    faults = Faults(dropped=1, bit_flips=1, lost_bytes=1, late=1)
    with virtual_board(local_echo=True, faults=faults) as board:
        host = host_of(board)
        board.reboot(1.0)
        for data in (ASK, MOVE, ActionGroupStop().encode()):
            host.transport.write(data)
            assert host.collect(len(data)) == data
        board.unplug()
        board.plug_in()
        assert board.open().read(0.1) == b""


def test_there_is_no_echo_by_default(connect: Callable[..., tuple[Any, Host]]) -> None:
    _, host = connect()
    host.transport.write(MOVE)
    host.transport.write(ASK)
    assert host.collect(len(REPLY)) == REPLY


@pytest.mark.garbage
def test_an_adapter_gives_back_what_was_sent_at_whatever_rate() -> None:
    line = Line(Board(), baud=9600, local_echo=True)
    line.host_baud = 115200
    line.write(MOVE, 0.0)
    assert b"".join(line.read(10.01 / 11520)) == MOVE
    line.read(1.0)
    assert line.board.heard == 0
