"""Both ends of this project together: the client against the virtual controller."""

from __future__ import annotations

import pytest
from busservo import (
    ActionGroupCompleted,
    BatteryVoltage,
    Controller,
    NoReportError,
)

from tests.lines.at_board import client_at, virtual_board


def test_a_motion_and_a_group_from_beginning_to_end() -> None:
    with virtual_board(servos=range(1, 7)) as board:
        with client_at(board, Controller, settle=None) as controller:
            controller.move_servos([(1, 800), (2, 200)], time_ms=1000)
            assert list(controller.reports(timeout=1.1)) == []
            assert controller.read_servo_positions([1, 2]) == ((1, 800), (2, 200))
            controller.run_action_group(8, times=1)
            done = controller.wait_for(ActionGroupCompleted, group=8, timeout=60)
            assert done == ActionGroupCompleted(8, 1)
            controller.set_action_group_speed(0xFF, percent=300)
            controller.stop_action_group()
            controller.unload_servos([1, 2, 3])
            assert (
                controller.read_battery_voltage()
                == BatteryVoltage(board.battery.voltage_mv).voltage_mv
            )
            with pytest.raises(NoReportError):
                controller.wait_for(ActionGroupCompleted, group=8, timeout=1)
        assert board.rejects.total == 0


def test_positions_are_read_at_the_speed_of_the_wire() -> None:
    """By the board's own clock; on the clock of a machine, `python -m benchmarks.line` measures."""
    with (
        virtual_board(baud=9600) as board,
        client_at(board, Controller) as controller,
    ):
        for _ in range(60):
            assert len(controller.read_servo_positions(range(1, 7))) == 6
        assert 60 * 34 / 960 / board.clock.now() >= 0.999


def test_commands_fill_the_wire_and_no_more() -> None:
    with virtual_board(baud=9600) as board:
        with client_at(board, Controller, settle=None) as controller:
            moves = [(servo, 500) for servo in range(1, 7)]
            for _ in range(100):
                # What is said of when it will be on the wire holds: no lag builds up unseen.
                assert controller.move_servos(moves, time_ms=20).delay < 0.005
        assert board.clock.now() == pytest.approx(100 * 25 / 960, abs=0.01)
        assert board.accepted == 100
