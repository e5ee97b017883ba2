"""Runs, and the reports that acknowledge them: what the result of a run says, and when."""

from collections.abc import Iterable
from functools import partial
from typing import Any

import busservo
from busservo import ActionGroupRun, ActionGroupStarted, BatteryVoltage, Message, ServoPositionsRead

from tests.lines.both_clients import both, both_live, until
from tests.lines.live_line import LiveLine
from tests.lines.questions import REPLY_TIMEOUT
from tests.lines.stories import Step, Told, ask, hear, replied, restart, send, tick, told, want

FRAME = 7 / 960  # of a run, and of its report
# When a run that is sent at 0 is taken to have been ignored.
OVER = 2 * FRAME + REPLY_TIMEOUT
STARTED = ActionGroupStarted(8, 1)


SEEN_ONE = hear(-10.0, ActionGroupStarted(99, 1))  # of a line that has carried such a report


def run(group: int = 8, at: float = 0.0) -> Step:
    """Run a group; the port has the command at once."""

    def step(it: Told) -> None:
        want(ActionGroupRun(group, 1))(it)
        it.line.outgoing(at)
        it.line.acknowledgements.written(at)
        started(None)(it)

    return step


def started(*expected: bool | None) -> Step:
    """Check what is known of the runs so far."""

    def step(it: Told) -> None:
        runs = [each.sent for each in it.requests if each.sent is not None]
        assert [each.started for each in runs][-len(expected) :] == [*expected]

    return step


def comes(report: Message, known: bool | None) -> list[Step]:
    """A run is acknowledged by a report or not; what has come meanwhile took its time, too."""
    over = OVER + len(report.encode()) / 960
    return [
        *[SEEN_ONE, run(), hear(0.1, report), started(known), tick(over - 0.001), started(known)],
        *[tick(over), started(bool(known))],
    ]


def lose(it: Told) -> None:
    it.line.fail(busservo.DisconnectedError("line", "lost", "again"))


def written(at: float, place: int = -1) -> Step:
    return lambda it: it.line.acknowledgements.written(at, it.requests[place].sent)


def unwritten(it: Told) -> None:
    assert it.line.acknowledgements.unwritten


def nothing_is_due(it: Told) -> None:
    assert it.line.tick_at is None


LONG = busservo.ServoPositions([(servo, 500) for servo in range(84)])
PIECES = [LONG.encode()[at : at + 16] for at in range(0, len(LONG.encode()), 16)]
PIECES_AT = [0.36 + 16 * place / 960 for place in range(len(PIECES))]
HALF, REST = STARTED.encode()[:3], STARTED.encode()[3:]
test_a_run = told(
    {
        "is acknowledged by the report with its values": comes(STARTED, True),
        "is not by one with other times": comes(ActionGroupStarted(8, 2), None),
        "is not by one of another group": comes(ActionGroupStarted(7, 1), None),
        "is not by another report": comes(busservo.ActionGroupCompleted(8, 1), None),
        "is not by a reply": comes(BatteryVoltage(7500), None),
        "is expected to be reported only where one has been": [
            *[run(), tick(OVER), hear(5.0, STARTED), run(at=10.0), tick(10 + OVER - 1e-6)],
            *[started(None, None), tick(10 + OVER + 1e-6), started(None, False), nothing_is_due],
        ],
        "wants a report of its own, as does its equal": [
            *[SEEN_ONE, run(), run(at=0.01), hear(0.1, STARTED), started(True, None)],
            *[hear(0.1, STARTED), started(True, True)],
        ],
        "is not late behind a long reply, which comes piece by piece": [
            *[SEEN_ONE, ask(0.0, ServoPositionsRead(range(84))), run(at=0.1)],
            *(
                each
                for at, data in zip(PIECES_AT, PIECES, strict=True)
                for each in (hear(at, data), tick(at))
            ),
            *[replied(LONG, 0), started(None)],
            *[hear(0.36 + (len(LONG.encode()) + 7) / 960, STARTED), started(True)],
        ],
        "waits for half a report": [
            *[SEEN_ONE, run(), hear(OVER - 0.002, HALF), tick(OVER + 0.02), started(None)],
            *[hear(OVER + 0.03, REST), started(True)],
        ],
        "has its time from when the port has it": [
            *[SEEN_ONE, want(ActionGroupRun(8, 1)), send(0.0, ActionGroupRun(8, 1)), tick(5.0)],
            *[started(None), unwritten, written(5.0), tick(5.0 + OVER - 0.001), started(None)],
            *[tick(5.0 + OVER), started(False)],
        ],
        "has no deadline before": [
            *[SEEN_ONE, *(want(ActionGroupRun(group, 1)) for group in (1, 2, 3))],
            *(send(group / 10, ActionGroupRun(group, 1)) for group in (1, 2, 3)),
            *[written(0.3, -2), tick(1.0), started(False, False, None), unwritten],
        ],
        "is not known of on a new line": [
            *[SEEN_ONE, run(), lose, restart(1.0), tick(5.0), run(at=6.0), tick(10.0)],
            started(None, None),
        ],
    }
)


class Board:
    """A board that reports after how many milliseconds each group has started; None for never."""

    def __init__(self, delays: list[int | None]) -> None:
        self._delays = delays
        self._free_at = 0.0
        self._on_the_wire: list[tuple[float, int]] = []

    def receive(self, frame: bytes, at: float) -> None:
        match busservo.decode(frame, busservo.Direction.HOST_TO_CONTROLLER):
            case ActionGroupRun(group, times):
                delay = self._delays[group]
                if delay is not None:
                    self._say(at + delay / 1000, ActionGroupStarted(group, times))
            case ServoPositionsRead(servo_ids):
                self._say(at, busservo.ServoPositions([(servo, 500) for servo in servo_ids]))

    def _say(self, at: float, message: Message) -> None:
        for byte in message.encode():
            self._free_at = max(self._free_at, at) + 1 / 960
            self._on_the_wire.append((self._free_at, byte))

    def arrived(self, now: float) -> bytes:
        data = bytes(byte for at, byte in self._on_the_wire if at <= now)
        self._on_the_wire = [each for each in self._on_the_wire if each[0] > now]
        return data


# -------------------------------------------------------------------- both clients
def of_group_8(message: Message) -> Iterable[tuple[float, Message]]:
    """Yield the messages of a board that has group 8 and no other."""
    if isinstance(message, ActionGroupRun) and message.group == 8:
        yield 0.02, ActionGroupStarted(message.group, message.times)
    elif isinstance(message, busservo.BatteryVoltageRead):
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
    assert (await controller.stop_action_group()).message == busservo.ActionGroupStop()
    assert isinstance(await controller.send(ActionGroupRun(8, 1)), busservo.Run)


def known(run: busservo.Run) -> bool:
    return run.started is not None


def on_group_8() -> LiveLine:
    return LiveLine(lambda message: [each for _, each in of_group_8(message)])


@both_live(on_group_8, reply_timeout=0.05)
async def test_a_run_that_the_board_ignores_is_seen_where_nobody_asks(controller: Any) -> None:
    for group in (8, 7):
        run = await controller.run_action_group(group, times=1)
        await until(controller, partial(known, run))
        assert run.started is (group == 8)
