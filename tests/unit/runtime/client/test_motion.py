"""Motions: when they end, and waiting for that; moves of which the latest wins."""

from __future__ import annotations

import asyncio
import math
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import pytest
from busservo import (
    ActionGroupStopped,
    AsyncMotion,
    ClosedError,
    Controller,
    DisconnectedError,
    Motion,
    ServoMove,
)

from tests.in_turn import in_turn
from tests.lines.at_board import client_at, virtual_board
from tests.lines.live_line import LiveLine, answered
from tests.lines.virtual_line import VirtualLine, client, run
from tests.timeouts import GENEROUS, LIVE

if TYPE_CHECKING:
    from collections.abc import Iterator

MOVE = 10 / 960  # a move of one servo, on the wire
SIX = [(servo, 500) for servo in range(1, 7)]
# More than any wait of a test: what ends one before is what the test is about.
LONG = 60_000


class Virtual:
    """A client of a line in virtual time, and the line."""

    def __init__(self, **settings: float) -> None:
        self.line = VirtualLine()
        self.controller = Controller(
            self.line,
            background=False,
            clock=self.line.clock,
            **settings,  # type: ignore[arg-type]
        )


@pytest.fixture
def virtual() -> Iterator[Virtual]:
    made = Virtual()
    with made.controller:
        yield made


# -------------------------------------------------------------------- when it ends


@pytest.mark.parametrize("time_ms", [0, 1, 1000, 65535])
def test_a_motion_ends_once_its_frame_has_left_and_its_time_is_over(
    virtual: Virtual, time_ms: int
) -> None:
    line, controller = virtual.line, virtual.controller
    motion = controller.move_servos([(1, 800)], time_ms)
    assert isinstance(motion, Motion)
    assert motion.ends_at == pytest.approx(line.now + MOVE + time_ms / 1000)
    assert motion.remaining == pytest.approx(MOVE + time_ms / 1000)
    assert motion.lasts == time_ms / 1000
    assert motion.wait()
    assert motion.ends_at is not None
    assert motion.ends_at <= line.now < motion.ends_at + 0.001
    assert motion.remaining == 0.0
    assert motion.wait(), "it may be waited for again"


def test_what_stands_before_it_on_the_wire_puts_off_its_end(virtual: Virtual) -> None:
    controller = virtual.controller
    controller.move_servos([(servo, 500) for servo in range(1, 80)], 0)
    began = virtual.line.now
    motion = controller.move_servos([(1, 800)], 100)
    queued = motion.delay + (virtual.line.now - began)
    assert queued == pytest.approx((7 + 79 * 3) / 960, abs=0.001)
    assert motion.ends_at == pytest.approx(began + queued + MOVE + 0.1, abs=0.001)


def test_a_line_that_takes_no_time_takes_none_of_a_motion() -> None:
    made = Virtual(baud=math.inf)
    motion = made.controller.move_servos(SIX, 500)
    assert motion.ends_at == made.line.now + 0.5
    made.controller.close()


def test_whatever_sends_it_a_move_is_a_motion(virtual: Virtual) -> None:
    sent = virtual.controller.send(ServoMove(250, SIX))
    assert isinstance(sent, Motion)
    assert repr(sent) == (
        f"Motion({ServoMove(250, SIX)!r}, delay=0.0000, duration=0.0260, lasts=0.25)"
    )
    assert sent.wait()


def test_with_a_board_in_virtual_time_the_servo_is_there_when_the_motion_is_over() -> None:
    with (
        virtual_board(baud=9600) as board,
        client_at(board, Controller, settle=None) as controller,
    ):
        controller.move_servos([(1, 800)], 1000).wait()
        assert 1.0 < board.clock.now() < 1.1
        assert controller.read_servo_positions([1]) == ((1, 800),)


# -------------------------------------------------------------------- while it is waited for


def test_reports_are_kept_and_delivered_while_a_motion_is_waited_for(virtual: Virtual) -> None:
    line, controller = virtual.line, virtual.controller
    received: list[float] = []
    controller.on_report(lambda _: received.append(line.now))
    motion = controller.move_servos([(1, 800)], 1000)
    line.say(ActionGroupStopped(), 0.5)
    motion.wait()
    assert received == [pytest.approx(0.5, abs=0.03)]
    assert list(controller.reports(timeout=0)) == [ActionGroupStopped()]


def test_a_line_that_is_lost_or_closed_ends_the_wait(virtual: Virtual) -> None:
    line, controller = virtual.line, virtual.controller
    over = controller.move_servos([(1, 800)], 10)
    over.wait()
    motion = controller.move_servos([(1, 800)], 1000)
    line.error = OSError("the cable is out")
    with pytest.raises(DisconnectedError, match="the cable is out"):
        motion.wait()
    controller.close()
    with pytest.raises(ClosedError):
        motion.wait()
    assert over.wait(), "it had ended before"


def test_closing_in_another_thread_ends_the_wait() -> None:
    with ThreadPoolExecutor() as pool, Controller(LiveLine()) as controller:
        motion = controller.move_servos([(1, 800)], LONG)
        pending = pool.submit(motion.wait)
        assert not pending.done()
        controller.close()
        with pytest.raises(ClosedError):
            pending.result(GENEROUS)


def test_a_motion_is_waited_for_while_others_talk() -> None:
    with ThreadPoolExecutor() as pool, Controller(LiveLine(), **LIVE) as controller:
        motions = [controller.move_servos([(servo, 800)], 50) for servo in range(1, 5)]
        pending = [pool.submit(motion.wait) for motion in motions]
        assert controller.read_battery_voltage() == 7500
        assert [each.result(GENEROUS) for each in pending] == [True] * 4
        assert all(motion.remaining == 0.0 for motion in motions)


# -------------------------------------------------------------------- of which the latest wins


def test_the_latest_move_takes_the_place_of_what_waits(virtual: Virtual) -> None:
    line, controller = virtual.line, virtual.controller
    first, second, third = (
        controller.move_servos([(1, position)], 100, latest=True) for position in (10, 20, 30)
    )
    other = controller.move_servos([(2, 40)], 100, latest=True)
    assert line.now == 0, "none of them waits for the line"
    assert first.ends_at == pytest.approx(MOVE + 0.1)
    assert (second.ends_at, second.remaining, second.replaced) == (None, None, True)
    assert (third.ends_at, third.remaining, third.replaced) == (None, None, False)
    assert third.delay == pytest.approx(MOVE)
    assert not second.wait()
    assert line.now == 0
    assert third.wait()
    assert line.now == pytest.approx(2 * MOVE + 0.1, abs=0.001)
    assert other.wait()
    assert line.received == [ServoMove(100, [each]) for each in [(1, 10), (1, 30), (2, 40)]]
    assert controller.counters.replaced == 1


def test_a_move_that_never_left_ends_with_the_error(virtual: Virtual) -> None:
    line, controller = virtual.line, virtual.controller
    controller.move_servos([(1, 10)], 100, latest=True)
    motion = controller.move_servos([(1, 20)], 100, latest=True)
    line.error = OSError("the cable is out")
    for _ in range(2):
        with pytest.raises(DisconnectedError, match="the cable is out"):
            motion.wait()
    assert not motion.replaced


# -------------------------------------------------------------------- asyncio


def test_a_motion_is_waited_for_in_a_task() -> None:
    line = VirtualLine(answered)

    async def work() -> None:
        async with client(line, **LIVE) as controller:
            began = line.now
            motion = await controller.move_servos([(1, 800)], time_ms=50)
            assert isinstance(motion, AsyncMotion)
            assert isinstance(await controller.send(ServoMove(0, SIX)), AsyncMotion)
            assert motion.lasts == 0.05
            line.say(ActionGroupStopped())
            assert await asyncio.wait_for(motion.wait(), GENEROUS)
            assert motion.remaining == 0.0
            assert line.now == pytest.approx(began + 0.05, abs=1e-4)
            assert await motion.wait(), "it may be waited for again"
            received = [report async for report in controller.reports(timeout=0)]
            assert received == [ActionGroupStopped()]

    run(work(), line)


def test_in_a_task_the_latest_move_takes_the_place_of_what_waits() -> None:
    async def work() -> None:
        line = VirtualLine(answered)
        async with client(line, baud=1000) as controller:
            motions = [
                await controller.move_servos([(1, position)], 20, latest=True)
                for position in range(50)
            ]
            pending = asyncio.gather(*(motion.wait() for motion in motions))
            ended = await asyncio.wait_for(pending, GENEROUS)
            assert ended == [not motion.replaced for motion in motions]
            assert (ended[0], ended[-1], sum(ended)) == (True, True, 2)
            moves = [message for message in line.received if isinstance(message, ServoMove)]
            assert [move.targets[0].position for move in moves] == [
                position for position, motion in enumerate(motions) if not motion.replaced
            ]

    run(work())


@in_turn("latest", lambda: [False, True])
def test_in_a_task_a_line_that_is_lost_or_closed_ends_the_wait(latest: bool) -> None:
    async def work() -> None:
        for error in (DisconnectedError, ClosedError):
            line = VirtualLine(answered)
            async with client(line, baud=1000) as controller:
                await controller.move_servos([(1, 500)], 20)
                motion = await controller.move_servos([(1, 800)], LONG, latest=latest)
                pending = asyncio.ensure_future(motion.wait())
                await asyncio.sleep(0)
                if error is ClosedError:
                    await controller.close()
                else:
                    line.unplug()
                with pytest.raises(error):
                    await asyncio.wait_for(pending, GENEROUS)

    run(work())


def test_a_wait_that_is_cancelled_leaves_the_line_usable() -> None:
    async def work() -> None:
        async with client(VirtualLine(answered), **LIVE) as controller:
            motion = await controller.move_servos([(1, 800)], LONG)
            with pytest.raises(asyncio.TimeoutError):
                await asyncio.wait_for(motion.wait(), 0.01)
            assert await controller.read_battery_voltage() == 7500

    run(work())
