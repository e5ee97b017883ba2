"""Runs, and the reports that acknowledge them: what the result of a run says, and when."""

import math
from collections import deque
from collections.abc import Iterable
from itertools import accumulate
from typing import Any

import busservo
import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupRun,
    ActionGroupStarted,
    ActionGroupStop,
    BatteryVoltage,
    BatteryVoltageRead,
    Direction,
    DisconnectedError,
    Message,
    Run,
    ServoPositions,
    ServoPositionsRead,
)
from framewire.client.session import Session
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.lines.both_clients import both, both_live, until
from tests.lines.live_line import LiveLine
from tests.lines.questions import REPLY_TIMEOUT, ask, say, session

FRAME = 7 / 960  # of a run, and of its report
# When a run that is sent at 0 is taken to have been ignored.
OVER = 2 * FRAME + REPLY_TIMEOUT
STARTED = ActionGroupStarted(8, 1)


def seen_one() -> Session:
    """Return a session of a line that has carried an acknowledging report, long ago."""
    line = session()
    say(line, -10.0, ActionGroupStarted(99, 1))
    return line


def ran(line: Session, group: int = 8, now: float = 0.0) -> Run:
    request = line.submit(ActionGroupRun(group, 1))
    line.outgoing(now)
    line.acknowledgements.written(now)
    assert isinstance(request.sent, Run)
    assert request.sent.started is None
    return request.sent


@in_turn(
    "report, started",
    lambda: [
        (STARTED, True),
        (ActionGroupStarted(8, 2), None),
        (ActionGroupStarted(7, 1), None),
        (ActionGroupCompleted(8, 1), None),
        (BatteryVoltage(7500), None),
    ],
)
def test_a_run_is_acknowledged_by_the_report_with_its_values(
    report: Message, started: bool | None
) -> None:
    line = seen_one()
    run = ran(line)
    say(line, 0.1, report)
    assert run.started is started
    # What has come meanwhile took its time, too.
    line.tick(OVER + len(report.encode()) / 960 - 0.001)
    assert run.started is started
    line.tick(OVER + len(report.encode()) / 960)
    assert run.started is bool(started)


def test_a_line_that_never_reported_a_start_expects_none() -> None:
    line = session()
    first = ran(line)
    line.tick(OVER)
    say(line, 5.0, STARTED)
    second = ran(line, now=10.0)
    assert line.tick_at == pytest.approx(10 + OVER)
    line.tick(10 + OVER + 1e-6)
    assert (first.started, second.started) == (None, False)
    assert line.tick_at is None


def test_each_of_two_equal_runs_wants_a_report_of_its_own() -> None:
    line = seen_one()
    first, second = ran(line), ran(line, now=0.01)
    say(line, 0.1, STARTED)
    assert (first.started, second.started) == (True, None)
    say(line, 0.1, STARTED)
    assert second.started is True


def test_a_long_reply_before_the_report_does_not_make_it_late() -> None:
    line = seen_one()
    question = ask(line, 0.0, ServoPositionsRead(range(84)))
    run = ran(line, now=0.1)
    reply = ServoPositions([(servo, 500) for servo in range(84)]).encode()
    # It comes piece by piece, and the report behind it.
    for at in range(0, len(reply), 16):
        now = 0.36 + at / 960
        line.receive(reply[at : at + 16], now)
        line.tick(now)
    assert question.reply is not None
    assert run.started is None
    say(line, 0.36 + (len(reply) + 7) / 960, STARTED)
    assert run.started is True


def test_half_a_report_is_waited_for() -> None:
    line = seen_one()
    run = ran(line)
    report = STARTED.encode()
    line.receive(report[:3], OVER - 0.002)
    line.tick(OVER + 0.02)
    assert run.started is None
    line.receive(report[3:], OVER + 0.03)
    assert run.started is True


def test_the_time_of_a_run_begins_when_the_port_has_it() -> None:
    line = seen_one()
    request = line.submit(ActionGroupRun(8, 1))
    line.outgoing(0.0)
    assert isinstance(request.sent, Run)
    line.tick(5.0)
    assert request.sent.started is None
    assert line.acknowledgements.unwritten
    line.acknowledgements.written(5.0)
    line.tick(5.0 + OVER - 0.001)
    assert request.sent.started is None
    line.tick(5.0 + OVER)
    assert request.sent.started is False


def test_a_run_not_yet_written_has_no_deadline() -> None:
    line = seen_one()
    first, second, third = (line.submit(ActionGroupRun(group, 1)) for group in (1, 2, 3))
    for now in (0.0, 0.1, 0.2):
        line.outgoing(now)
    line.acknowledgements.written(0.2, second.sent)
    line.tick(1.0)
    started = [getattr(each.sent, "started", ...) for each in (first, second, third)]
    assert started == [False, False, None]
    assert line.acknowledgements.unwritten


def test_a_new_line_knows_nothing_of_runs_on_the_old_one() -> None:
    line = seen_one()
    run = ran(line)
    line.fail(DisconnectedError("line", "lost", "again"))
    line.restart(1.0)
    line.tick(5.0)
    other = ran(line, now=6.0)
    line.tick(10.0)
    assert (run.started, other.started) == (None, None)


def test_more_runs_than_are_followed_do_no_harm() -> None:
    line = session(baud=math.inf)
    runs = [ran(line, group) for group in range(100)]
    for group in range(100):
        say(line, 0.1, ActionGroupStarted(group, 1))
    assert {run.started for run in runs} == {None, True}
    assert runs[-1].started is True


class Board:
    """A board that reports after how many milliseconds each group has started; None for never."""

    def __init__(self, delays: list[int | None]) -> None:
        self._delays = delays
        self._free_at = 0.0
        self._on_the_wire: list[tuple[float, int]] = []

    def receive(self, frame: bytes, at: float) -> None:
        match busservo.decode(frame, Direction.HOST_TO_CONTROLLER):
            case ActionGroupRun(group, times):
                delay = self._delays[group]
                if delay is not None:
                    self._say(at + delay / 1000, ActionGroupStarted(group, times))
            case ServoPositionsRead(servo_ids):
                self._say(at, ServoPositions([(servo, 500) for servo in servo_ids]))

    def _say(self, at: float, message: Message) -> None:
        for byte in message.encode():
            self._free_at = max(self._free_at, at) + 1 / 960
            self._on_the_wire.append((self._free_at, byte))

    def arrived(self, now: float) -> bytes:
        data = bytes(byte for at, byte in self._on_the_wire if at <= now)
        self._on_the_wire = [each for each in self._on_the_wire if each[0] > now]
        return data


@given(
    st.lists(
        # How much later than the one before it is requested, how long the board takes to say so,
        # and how many servos are read right behind it.
        st.tuples(
            st.sampled_from([0, 1, 50, 300, 600]),
            st.none() | st.integers(0, 240),
            st.sampled_from([0, 0, 1, 6, 84]),
        ),
        min_size=1,
        max_size=6,
    ),
    st.integers(3, 40),
)
def test_acknowledgements_match_what_the_board_has_done(
    requested: list[tuple[int, int | None, int]], step: int
) -> None:
    """Over a line that is read every `step` milliseconds, and has no room for all at once."""
    line, board = seen_one(), Board([delay for _, delay, _ in requested])
    times = accumulate(later for later, _, _ in requested)
    pending = deque(zip(times, range(6), (servos for _, _, servos in requested), strict=False))
    sent = []
    for now in (at / 1000 for at in range(0, 8000, step)):
        while pending and pending[0][0] / 1000 <= now:
            _, group, servos = pending.popleft()
            sent.append(line.submit(ActionGroupRun(group, 1)))
            if servos:
                line.submit(ServoPositionsRead(range(servos)))
        for frame in line.outgoing(now):
            board.receive(frame, line.wire_time.free_at)
        line.acknowledgements.written(now)
        if line.unwritten is not None:
            line.written(line.unwritten, now)
        line.receive(board.arrived(now), now)
        line.tick(now)
    started = [each.sent.started for each in sent if isinstance(each.sent, Run)]
    assert started == [delay is not None for _, delay, _ in requested]


# -------------------------------------------------------------------- both clients


def of_group_8(message: Message) -> Iterable[tuple[float, Message]]:
    """Yield the messages of a board that has group 8 and no other."""
    if isinstance(message, ActionGroupRun) and message.group == 8:
        yield 0.02, ActionGroupStarted(message.group, message.times)
    elif isinstance(message, BatteryVoltageRead):
        yield 0.02, BatteryVoltage(7500)


@both(of_group_8)
async def test_a_run_that_the_board_ignores_is_seen(controller: Any, line: Any) -> None:
    ignored = await controller.run_action_group(7, times=1)
    while line.now < 1:
        await controller.read_battery_voltage()
    # Nobody knows yet that this board says so.
    assert ignored.started is None
    taken = await controller.run_action_group(8, times=1)
    assert repr(taken) == (
        "Run(ActionGroupRun(group=8, times=1), "
        f"delay={taken.delay:.4f}, duration=0.0073, started=None)"
    )
    await controller.read_battery_voltage()
    assert (ignored.started, taken.started) == (None, True)
    ignored = await controller.run_action_group(7, times=1)
    # Nobody asks anything: the client listens, and time passes, all the same.
    assert [each async for each in controller.reports(timeout=1)] == [STARTED]
    assert ignored.started is False
    assert (await controller.stop_action_group()).message == ActionGroupStop()
    assert isinstance(await controller.send(ActionGroupRun(8, 1)), Run)


def on_group_8() -> LiveLine:
    return LiveLine(lambda message: [each for _, each in of_group_8(message)])


@both_live(on_group_8, reply_timeout=0.05)
async def test_a_run_that_the_board_ignores_is_seen_where_nobody_asks(controller: Any) -> None:
    for group in (8, 7):
        run = await controller.run_action_group(group, times=1)
        await until(controller, lambda run=run: run.started is not None)
        assert run.started is (group == 8)
