"""The faults that only the line of a board has: in what it says of servos, and unsolicited."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupStarted,
    ActionGroupStopped,
    BatteryVoltage,
    BatteryVoltageRead,
    ServoPositions,
    ServoPositionsRead,
)
from busservo_simulator import Faults, VirtualController
from framewire.simulator.line_faults import LineFaults

if TYPE_CHECKING:
    from tests.lines.hosts import Host


def test_a_reply_counts_one_too_many_or_too_few(board: VirtualController, host: Host) -> None:
    board.faults = Faults(seed=7, wrong_count=1)
    frames = set()
    for _ in range(20):
        host.say(ServoPositionsRead([1, 2]))
        frames.add(board.transport.read(1).hex(" "))
    assert frames == {f"55 55 09 15 {count} 01 f4 01 02 f4 01" for count in ("01", "03")}
    assert host.ask(BatteryVoltageRead()) == BatteryVoltage(7500)  # it has no count


def test_servos_are_left_out_or_reported_to_be_off(board: VirtualController, host: Host) -> None:
    board.faults = Faults(seed=7, fewer=0.3, absent=0.3)
    counts, values = set(), set()
    for _ in range(50):
        reply = host.ask(ServoPositionsRead(range(1, 7)))
        assert isinstance(reply, ServoPositions)
        counts.add(len(reply.positions))
        values |= {position.position for position in reply.positions}
    assert len(counts) > 2
    assert values == {500, 65535}


def test_unsolicited_reports_are_sent(board: VirtualController, host: Host) -> None:
    board.faults = Faults(seed=7, unsolicited=1)
    kinds = set()
    for _ in range(30):
        kinds.add(type(host.ask(BatteryVoltageRead())))
        assert host.receive() == BatteryVoltage(7500)
    assert kinds == {ActionGroupStarted, ActionGroupStopped, ActionGroupCompleted}


def test_faults_of_any_line_are_not_enough() -> None:
    with pytest.raises(TypeError, match="Faults are wanted, not LineFaults"):
        VirtualController(faults=LineFaults())
