"""The board's behaviour: servos, action groups, battery, LED, buzzer, and when it is silent."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupRun,
    ActionGroupSpeed,
    ActionGroupStarted,
    ActionGroupStop,
    ActionGroupStopped,
    BatteryVoltage,
    BatteryVoltageRead,
    ServoMove,
    ServoPositions,
    ServoPositionsRead,
    ServoUnload,
)
from busservo_simulator import ActionGroup, Step, VirtualController

from tests.in_turn import in_turn
from tests.lines.at_board import virtual_board
from tests.lines.hosts import Host, host_of

if TYPE_CHECKING:
    from collections.abc import Iterator

NOD = ActionGroup([Step(300, {1: 600}), Step(200, {1: 400})])


def positions(host: Host, *servo_ids: int) -> list[tuple[int, int]]:
    """Return the board's reply about servos."""
    reply = host.ask(ServoPositionsRead(servo_ids))
    assert isinstance(reply, ServoPositions)
    return [(servo_id, position) for servo_id, position in reply.positions]


# -------------------------------------------------------------------- servos


def test_servos_begin_at_the_centre_and_hold(board: VirtualController, host: Host) -> None:
    assert positions(host, 1, 6) == [(1, 500), (6, 500)]
    assert all(servo.loaded for servo in board.servos.values())


def test_a_servo_travels_to_its_target_in_the_given_time(
    board: VirtualController, host: Host
) -> None:
    host.say(ServoMove(1000, [(1, 800), (2, 100)]))
    board.advance(0.5)
    assert positions(host, 1, 2, 3) == [(1, 650), (2, 300), (3, 500)]
    board.advance(0.5)
    assert positions(host, 1, 2, 3) == [(1, 800), (2, 100), (3, 500)]


def test_a_new_target_is_travelled_to_from_where_the_servo_is(
    board: VirtualController, host: Host
) -> None:
    host.say(ServoMove(1000, [(1, 800)]))
    board.advance(0.5)
    host.say(ServoMove(1000, [(1, 550)]))
    board.advance(0.5)
    assert positions(host, 1) == [(1, 600)]


def test_no_servo_is_faster_than_it_can(board: VirtualController, host: Host) -> None:
    host.say(ServoMove(0, [(1, 1000)]))
    assert 500 < board.servos[1].position + 1 < 1000
    board.advance(0.1)
    assert board.servos[1].position == 656
    board.advance(0.3)
    assert board.servos[1].position == 1000


@pytest.mark.parametrize(("requested", "reached"), [(65535, 1000), (1001, 1000), (0, 0)])
def test_a_servo_goes_no_further_than_it_can(
    board: VirtualController, host: Host, requested: int, reached: int
) -> None:
    host.say(ServoMove(500, [(1, requested)]))
    board.advance(1)
    assert board.servos[1].position == reached


def test_an_unloaded_servo_stops_and_can_be_turned_by_hand(
    board: VirtualController, host: Host
) -> None:
    host.say(ServoMove(1000, [(1, 800)]))
    board.advance(0.5)
    host.say(ServoUnload([1]))
    board.advance(1)
    assert (board.servos[1].loaded, board.servos[1].position) == (False, 650)
    board.servos[1].turn_by_hand(200)
    assert positions(host, 1) == [(1, 200)]
    host.say(ServoMove(0, [(1, 200)]))
    assert board.servos[1].loaded


def test_a_servo_that_holds_cannot_be_turned_by_hand(board: VirtualController) -> None:
    with pytest.raises(ValueError, match="unload it first"):
        board.servos[1].turn_by_hand(200)


def test_number_254_is_every_servo(board: VirtualController, host: Host) -> None:
    host.say(ServoMove(500, [(254, 700)]), ServoUnload([254]))
    board.advance(1)
    assert not any(servo.loaded for servo in board.servos.values())


def test_a_servo_that_is_missing_is_left_out(board: VirtualController, host: Host) -> None:
    board.servos[2].missing = True
    assert positions(host, 1, 2, 3, 77) == [(1, 500), (3, 500)]
    assert positions(host, 2) == []


def test_a_servo_that_is_off_is_reported_as_65535_and_does_not_move(
    board: VirtualController, host: Host
) -> None:
    board.servos[2].off = True
    host.say(ServoMove(100, [(2, 900)]))
    board.advance(1)
    assert positions(host, 1, 2) == [(1, 500), (2, 65535)]
    board.servos[2].off = False
    assert positions(host, 2) == [(2, 500)]


def test_a_read_that_no_reply_could_hold_is_met_with_silence(
    board: VirtualController, host: Host
) -> None:
    assert len(positions(host, *range(84))) == 6
    assert host.ask(ServoPositionsRead(range(85))) is None
    assert board.rejects.total == 0
    assert "85 servos fit in no reply: silence" in str(board.log)


def test_a_servo_says_what_it_does(board: VirtualController, host: Host) -> None:
    assert repr(board.servos[1]) == "Servo(1, holding, position=500)"
    host.say(ServoUnload([1]))
    assert repr(board.servos[1]) == "Servo(1, limp, position=500)"


# -------------------------------------------------------------------- action groups


Nodding = tuple[VirtualController, Host]


@pytest.fixture
def nodding() -> Iterator[Nodding]:
    """Yield a board that knows group 5, and its host."""
    with virtual_board(groups={5: NOD}) as board:
        yield board, host_of(board)


def test_a_group_starts_runs_and_ends_with_a_report_each(nodding: Nodding) -> None:
    board, host = nodding
    assert host.ask(ActionGroupRun(5, 2)) == ActionGroupStarted(5, 2)
    board.advance(0.15)
    assert board.servos[1].position == 550
    board.advance(0.25)
    assert board.servos[1].position == 500
    assert host.receive() == ActionGroupCompleted(5, 2)
    assert board.clock.now() == pytest.approx(1.0)
    assert board.servos[1].position == 400


def test_a_group_without_end_runs_until_it_is_stopped(nodding: Nodding) -> None:
    _board, host = nodding
    assert host.ask(ActionGroupRun(5, 0)) == ActionGroupStarted(5, 0)
    assert host.receive(timeout=100) is None
    assert host.ask(ActionGroupStop()) == ActionGroupStopped()
    assert host.ask(ActionGroupStop()) is None


@pytest.mark.parametrize("group", [5, ActionGroupSpeed.GROUP_ALL])
def test_the_speed_changes_how_long_a_group_takes(nodding: Nodding, group: int) -> None:
    board, host = nodding
    host.say(ActionGroupSpeed(group, 200), ActionGroupRun(5, 1))
    assert host.receive() == ActionGroupStarted(5, 1)
    assert host.receive() == ActionGroupCompleted(5, 1)
    assert board.clock.now() == pytest.approx(0.25)


def test_a_speed_set_meanwhile_holds_from_the_next_step(nodding: Nodding) -> None:
    board, host = nodding
    host.ask(ActionGroupRun(5, 1))
    host.say(ActionGroupSpeed(5, 50))
    assert host.receive() == ActionGroupCompleted(5, 1)
    assert board.clock.now() == pytest.approx(0.3 + 0.4)


def test_a_speed_of_nothing_is_ignored(nodding: Nodding) -> None:
    board, host = nodding
    host.say(ActionGroupSpeed(5, 0), ActionGroupRun(5, 1))
    host.receive()
    assert host.receive() == ActionGroupCompleted(5, 1)
    assert board.clock.now() == pytest.approx(0.5)


def test_the_report_that_a_group_starts_can_be_left_out() -> None:
    with virtual_board(groups={5: NOD}, start_report=False) as board:
        assert host_of(board).ask(ActionGroupRun(5, 1)) == ActionGroupCompleted(5, 1)


def test_a_group_that_is_not_stored_is_met_with_silence(
    board: VirtualController, host: Host
) -> None:
    assert host.ask(ActionGroupRun(77, 1)) is None
    assert "77 is not stored: silence" in str(board.log)


def test_a_group_replaces_the_one_that_runs(nodding: Nodding) -> None:
    _board, host = nodding
    assert host.ask(ActionGroupRun(5, 0)) == ActionGroupStarted(5, 0)
    assert host.ask(ActionGroupRun(5, 1)) == ActionGroupStarted(5, 1)
    assert host.receive() == ActionGroupCompleted(5, 1)
    assert host.receive() is None


def test_the_button_on_the_board_is_reported_too(nodding: Nodding) -> None:
    board, host = nodding
    board.press_button(5)
    assert host.receive() == ActionGroupStarted(5, 1)
    board.press_button(None)
    assert host.receive() == ActionGroupStopped()


def test_groups_come_with_the_board(board: VirtualController, host: Host) -> None:
    for group in board.board.groups:
        assert host.ask(ActionGroupRun(group, 1)) == ActionGroupStarted(group, 1)
        assert host.receive() == ActionGroupCompleted(group, 1)


def test_an_action_group_without_steps_is_refused() -> None:
    with pytest.raises(ValueError, match="needs a step"):
        ActionGroup([])


# -------------------------------------------------------------------- battery


def voltage(host: Host) -> int:
    """Return the board's reply about its battery."""
    reply = host.ask(BatteryVoltageRead())
    assert isinstance(reply, BatteryVoltage)
    return reply.voltage_mv


def test_the_battery_sags_while_servos_travel_and_recovers(
    board: VirtualController, host: Host
) -> None:
    assert voltage(host) == 7500
    host.say(ServoMove(1000, [(1, 800), (2, 800)]))
    board.advance(0.5)
    assert voltage(host) == 7450
    board.advance(1)
    assert voltage(host) == 7500


def test_the_battery_runs_down_but_not_below_empty(board: VirtualController, host: Host) -> None:
    board.advance(3600)
    assert voltage(host) == 7440
    board.advance(100 * 3600)
    assert voltage(host) == 6000


@in_turn("asked_for", lambda: [0, 4700, 6000, 65535])
def test_a_battery_begins_where_it_is_asked_to(asked_for: int) -> None:
    with virtual_board(battery_mv=asked_for) as board:
        assert voltage(host_of(board)) == asked_for
        board.advance(500 * 3600)
        assert voltage(host_of(board)) == (asked_for if asked_for <= 6000 else 35535)


# -------------------------------------------------------------------- LED, buzzer, restart


@pytest.mark.garbage
def test_right_frames_blink_and_wrong_ones_beep(board: VirtualController, host: Host) -> None:
    host.say(BatteryVoltageRead())
    host.transport.write(bytes.fromhex("55 55 08 03 02 E8 03 01 20 03"))
    assert board.board.led_stays_on
    assert (board.accepted, board.rejects.total, board.board.beeps) == (1, 1, 2)
    assert [line.split(maxsplit=1)[1] for line in board.log] == [
        "LED2      blinks: BatteryVoltageRead()",
        "LED2      stays on",
        "buzzer    DiDi: count mismatch, 55 55 08 03 02 E8 03 01 20 03",
    ]
    host.say(BatteryVoltageRead())
    assert not board.board.led_stays_on


@pytest.mark.garbage
def test_a_wrong_frame_is_met_with_silence(board: VirtualController, host: Host) -> None:
    host.transport.write(bytes.fromhex("55 55 04 0F 4C 1D"))
    assert host.receive() is None
    assert voltage(host) == 7500


def test_a_board_that_restarts_receives_nothing_and_forgets_speeds_and_groups(
    nodding: Nodding,
) -> None:
    board, host = nodding
    host.say(ActionGroupSpeed(5, 200))
    host.ask(ActionGroupRun(5, 0))
    host.transport.write(b"\x55\x55\x08\x03")
    board.reboot(2.0)
    assert host.ask(BatteryVoltageRead()) is None or board.clock.now() >= 2.0
    board.advance(2)
    assert voltage(host) == 7500
    begun = board.clock.now()
    assert host.ask(ActionGroupRun(5, 1)) == ActionGroupStarted(5, 1)
    assert host.receive() == ActionGroupCompleted(5, 1)
    assert board.clock.now() - begun == pytest.approx(0.5)
    assert board.rejects.total == 0
