"""The board's behaviour: servos, action groups, battery, LED, buzzer, and when it is silent."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import busservo
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
from busservo_simulator import ActionGroup, Faults, Step, VirtualController
from framewire.simulator.line_faults import LineFaults

from tests.in_turn import in_turn
from tests.lines.at_board import virtual_board
from tests.lines.hosts import Host, host_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from tests.lines.hosts import Host

NOD = ActionGroup([Step(300, {1: 600}), Step(200, {1: 400})])


def positions(host: Host, *servo_ids: int) -> list[tuple[int, int]]:
    """Return the board's reply about servos."""
    reply = host.ask(ServoPositionsRead(servo_ids))
    assert isinstance(reply, ServoPositions)
    return [(servo_id, position) for servo_id, position in reply.positions]


def done(board: VirtualController, steps: Iterable[Any]) -> Host:
    """Send a board messages, wait so many seconds, or do something; return the host."""
    host = host_of(board)
    for step in steps:
        if callable(step):
            step(board)
        elif isinstance(step, float):
            board.advance(step)
        else:
            host.say(step)
    return host


# -------------------------------------------------------------------- servos

TO_800 = ServoMove(1000, [(1, 800), (2, 100)])


@in_turn(
    "steps, there",
    lambda: [
        ([], {1: 500, 6: 500}),
        ([TO_800, 0.5], {1: 650, 2: 300, 3: 500}),
        ([TO_800, 1.0], {1: 800, 2: 100, 3: 500}),
        # To a new target it travels from where it is.
        ([TO_800, 0.5, ServoMove(1000, [(1, 550)]), 0.5], {1: 600}),
        # No faster than it can, and no further.
        ([ServoMove(0, [(1, 1000)])], {1: 500}),
        ([ServoMove(0, [(1, 1000)]), 0.1], {1: 656}),
        *(([ServoMove(500, [(1, to)]), 1.0], {1: min(to, 1000)}) for to in (0, 1001, 65535)),
        ([TO_800, 0.5, ServoUnload([1]), 1.0], {1: 650, 2: 100}),
        ([TO_800, ServoUnload([1]), lambda board: board.servos[1].turn_by_hand(1200)], {1: 1000}),
        ([ServoMove(500, [(254, 700)]), 1.0], dict.fromkeys(range(1, 7), 700)),
    ],
)
def test_a_servo_is_where_it_was_sent(steps: list[Any], there: dict[int, int]) -> None:
    with virtual_board() as board:
        assert positions(done(board, steps), *there, 77) == [*there.items()]
        assert [board.servos[each].position for each in there] == [*there.values()]


def test_a_servo_holds_until_it_is_unloaded_and_from_the_next_move_on(
    board: VirtualController, host: Host
) -> None:
    servo = board.servos[1]
    with pytest.raises(ValueError, match="unload it first"):
        servo.turn_by_hand(200)
    shown = [repr(servo)]
    for message in (ServoUnload([254]), ServoMove(0, [(1, 500)])):
        host.say(message)
        shown.append(repr(servo))
    states = ["holding", "limp", "holding"]
    assert shown == [f"Servo(1, {state}, position=500)" for state in states]
    assert [each.loaded for each in board.servos.values()] == [True, *[False] * 5]


def test_a_servo_that_is_off_is_reported_as_65535_and_one_that_is_missing_not_at_all(
    board: VirtualController, host: Host
) -> None:
    board.servos[2].off = board.servos[4].missing = True
    done(board, [ServoMove(100, [(2, 900)]), 1.0])
    assert positions(host, 1, 2, 3, 4, 77) == [(1, 500), (2, 65535), (3, 500)]
    assert positions(host, 4) == []
    board.servos[2].off = False
    assert positions(host, 2) == [(2, 500)]


# -------------------------------------------------------------------- action groups

RUN, RUN_ON = ActionGroupRun(5, 1), ActionGroupRun(5, 0)
STARTED, COMPLETED = ActionGroupStarted(5, 1), ActionGroupCompleted(5, 1)
STARTED_ON, STOPPED = ActionGroupStarted(5, 0), ActionGroupStopped()


def press(group: int | None) -> Any:
    return lambda board: board.press_button(group)


@in_turn(
    "steps, reports, seconds",
    lambda: [
        ([RUN], [STARTED, COMPLETED], 0.5),
        ([ActionGroupRun(5, 2)], [ActionGroupStarted(5, 2), ActionGroupCompleted(5, 2)], 1.0),
        # The speed of one group or of all; from the next step on; and none of 0 %.
        ([ActionGroupSpeed(5, 200), RUN], [STARTED, COMPLETED], 0.25),
        ([ActionGroupSpeed(ActionGroupSpeed.GROUP_ALL, 200), RUN], [STARTED, COMPLETED], 0.25),
        ([ActionGroupSpeed(4, 200), RUN], [STARTED, COMPLETED], 0.5),
        ([RUN, ActionGroupSpeed(5, 50)], [STARTED, COMPLETED], 0.3 + 0.4),
        ([ActionGroupSpeed(5, 0), RUN], [STARTED, COMPLETED], 0.5),
        # Without end, until it is stopped or replaced.
        ([RUN_ON, 100.0, ActionGroupStop(), ActionGroupStop()], [STARTED_ON, STOPPED], 100.0),
        ([RUN_ON, RUN], [STARTED_ON, STARTED, COMPLETED], 0.5),
        ([ActionGroupRun(77, 1)], [], 0.0),
        ([press(5), press(None)], [STARTED, STOPPED], 0.0),
        # A restart forgets speeds, groups and half a frame.
        (
            [ActionGroupSpeed(5, 200), RUN_ON, lambda board: board.reboot(2.0), 2.0, RUN],
            [STARTED_ON, STARTED, COMPLETED],
            2.5,
        ),
    ],
)
def test_a_group_reports_what_it_does(steps: list[Any], reports: list[Any], seconds: float) -> None:
    with virtual_board(groups={5: NOD}) as board:
        host = done(board, steps)
        for report in reports:
            assert host.receive() == report
        assert board.clock.now() == pytest.approx(seconds)
        assert host.receive() is None
        assert ("77 is not stored: silence" in str(board.log)) == (not reports)


@in_turn("seconds, position", lambda: [(0.15, 550), (0.3, 600), (0.4, 500), (0.5, 400)])
def test_a_group_moves_servos(seconds: float, position: int) -> None:
    with virtual_board(groups={5: NOD}) as board:
        done(board, [RUN, seconds])
        assert board.servos[1].position == position


def test_the_report_that_a_group_starts_can_be_left_out() -> None:
    with virtual_board(groups={5: NOD}, start_report=False) as board:
        assert host_of(board).ask(RUN) == COMPLETED


def test_an_action_group_without_steps_is_refused() -> None:
    with pytest.raises(ValueError, match="needs a step"):
        ActionGroup([])


# -------------------------------------------------------------------- battery

BOTH = ServoMove(1000, [(1, 800), (2, 800)])
LONG = 500 * 3600.0


@in_turn(
    "begin, steps, voltage_mv",
    lambda: [
        (7500, [], 7500),
        # It sags while servos travel, and recovers.
        (7500, [BOTH, 0.5], 7450),
        (7500, [BOTH, 1.5], 7500),
        # It runs down, but not below empty, or where it began.
        (7500, [3600.0], 7440),
        *((begin, [], begin) for begin in (0, 4700, 6000, 65535)),
        *((begin, [LONG], min(begin, 6000)) for begin in (0, 4700, 6000, 7500)),
        (65535, [LONG], 35535),
    ],
)
def test_the_battery_has_the_voltage_of_the_moment(
    begin: int, steps: list[Any], voltage_mv: int
) -> None:
    with virtual_board(battery_mv=begin) as board:
        assert done(board, steps).ask(BatteryVoltageRead()) == BatteryVoltage(voltage_mv)


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


def test_a_board_that_restarts_receives_nothing(board: VirtualController, host: Host) -> None:
    host.transport.write(b"\x55\x55\x08\x03")
    board.reboot(2.0)
    host.say(BatteryVoltageRead())
    assert host.receive(1.9) is None
    board.advance(0.1)
    assert host.ask(BatteryVoltageRead()) == BatteryVoltage(7500)
    assert (board.accepted, board.rejects.total) == (1, 0)


# -------------------------------------------------------------------- the faults of its line alone
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
        assert isinstance(reply, busservo.ServoPositions)
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
    assert kinds == {busservo.ActionGroupStarted, busservo.ActionGroupStopped, ActionGroupCompleted}


def test_faults_of_any_line_are_not_enough() -> None:
    with pytest.raises(TypeError, match="Faults are wanted, not LineFaults"):
        VirtualController(faults=LineFaults())
