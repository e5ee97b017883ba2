"""The board behind a pty, behind TCP and in the same process: the same board every time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupRun,
    ActionGroupStarted,
    ActionGroupStop,
    BatteryVoltage,
    ServoMove,
    ServoPositions,
    ServoPositionsRead,
    ServoUnload,
)
from busservo_simulator import VirtualClock, VirtualController
from framewire.line.link_errors import TransportError

from tests.in_turn import in_turn
from tests.unit.runtime.simulator.conftest import ASK, STOPPED, VOLTAGE, host_at

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.lines.hosts import Host

    Connect = Callable[..., tuple[Any, Host]]

ALL = ServoPositionsRead(range(1, 7))


def test_every_request_is_met_as_it_should_be(connect: Connect) -> None:
    board, host = connect()
    assert host.ask(ASK) == VOLTAGE
    host.say(ServoMove(0, [(1, 510)]), ServoUnload([2]))
    assert isinstance(host.ask(ServoPositionsRead([1, 2])), ServoPositions)
    assert not board.servos[2].loaded
    assert host.ask(ActionGroupRun(2, 0)) == ActionGroupStarted(2, 0)
    assert host.ask(ActionGroupStop()) == STOPPED
    assert (board.accepted, board.rejects.total) == (6, 0)


def test_writes_may_be_cut_anywhere(connect: Connect) -> None:
    board, host = connect()
    request = ALL.encode()
    for cut in range(1, len(request)):
        host.transport.write(request[:cut])
        host.transport.write(request[cut:])
        assert isinstance(host.receive(), ServoPositions)
    assert board.rejects.total == 0


@pytest.mark.garbage
def test_a_stray_byte_costs_no_frame(connect: Connect) -> None:
    board, host = connect()
    for extra in ("00", "55", "FF 55", "55 55 FF"):
        before = board.rejects.total
        host.transport.write(bytes.fromhex(extra))
        host.say(ASK, ASK)
        assert [host.receive(), host.receive()] == [VOLTAGE, VOLTAGE]
        assert board.rejects.total > before


def test_replies_are_exact(connect: Connect) -> None:
    _, host = connect()
    host.say(ASK, ServoPositionsRead([3]))
    assert host.collect(14).hex(" ").upper() == "55 55 04 0F 4C 1D 55 55 06 15 01 03 F4 01"


def test_the_clock_can_be_moved_by_hand(connect: Connect) -> None:
    board, host = connect(clock=VirtualClock())
    host.say(ServoMove(1000, [(1, 900)]))
    assert host.ask(ASK) == BatteryVoltage(7475)  # one servo sets off
    board.advance(0.5)
    assert host.ask(ServoPositionsRead([1])) == ServoPositions([(1, 700)])
    # Reports come in the order of what happened.
    assert host.ask(ActionGroupRun(1, 1)) == ActionGroupStarted(1, 1)
    board.advance(10)
    assert host.ask(ASK) == ActionGroupCompleted(1, 1)
    assert host.receive() == VOLTAGE


def test_no_byte_comes_before_the_wire_could_carry_it(connect: Connect) -> None:
    _, host = connect(baud=9600)
    begun = time.monotonic()
    for _ in range(5):
        assert isinstance(host.ask(ALL), ServoPositions)
    assert time.monotonic() - begun >= 5 * 34 / 960


def test_a_fast_writer_is_slowed_to_the_line(connect: Connect) -> None:
    board, host = connect(baud=921600)
    host.say(*[ServoMove(0, [(1, 500)])] * 500)
    assert host.ask(ASK) == VOLTAGE
    assert (board.accepted, board.rejects.total) == (501, 0)


def test_a_host_is_listened_to_again_once_the_line_is_empty(
    connect: Connect, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("framewire.simulator.virtual_line.AHEAD", 1)
    _, host = connect(baud=96000)
    host.say(ServoMove(0, [(1, 500)]))
    time.sleep(0.05)
    assert host.ask(ASK) == VOLTAGE


def test_a_cable_can_be_pulled_and_put_back(connect: Connect) -> None:
    board, host = connect()
    assert host.ask(ASK) == VOLTAGE
    board.unplug()
    board.send_bytes(STOPPED.encode())  # which is lost
    with pytest.raises(TransportError):
        host.receive()
    board.plug_in()
    again = host_at(board)
    assert again.ask(ASK) == VOLTAGE
    assert again.received == []
    again.hang_up()


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
