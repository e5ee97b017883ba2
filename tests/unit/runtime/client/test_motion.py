"""Motions: when they end, and waiting for that; moves of which the latest wins."""

import asyncio
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import busservo
import pytest
from busservo import ClosedError, DisconnectedError, ServoMove

from tests.in_turn import in_turn
from tests.lines.both_clients import both
from tests.lines.live_line import LiveLine, answered
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine, client, in_virtual_time
from tests.timeouts import GENEROUS, LIVE

MOVE = 10 / 960  # a move of one servo, on the wire
SIX = [(servo, 500) for servo in range(1, 7)]
# More than any wait of a test: what ends one before is what the test is about.
LONG = 60_000


# -------------------------------------------------------------------- when it ends
@in_turn("time_ms", lambda: [0, 1, 1000, 65535])
@both()
async def test_a_motion_ends_once_its_frame_has_left_and_its_time_is_over(
    controller: Any, line: Any, time_ms: int
) -> None:
    motion = await controller.move_servos([(1, 800)], time_ms)
    assert motion.ends_at == pytest.approx(line.now + MOVE + time_ms / 1000)
    assert motion.remaining == pytest.approx(MOVE + time_ms / 1000)
    assert motion.lasts == time_ms / 1000
    assert await motion.wait()
    assert motion.ends_at <= line.now < motion.ends_at + 0.001
    assert motion.remaining == 0.0
    assert await motion.wait(), "it may be waited for again"


def test_whatever_sends_it_a_move_is_a_motion() -> None:
    with client_on(VirtualLine(), busservo.Controller) as controller:
        assert isinstance(controller.move_servos(SIX, 0), busservo.Motion)
        sent = controller.send(ServoMove(250, SIX))
        assert isinstance(sent, busservo.Motion)
        assert repr(sent) == (
            f"Motion({ServoMove(250, SIX)!r}, delay={sent.delay:.4f}, duration=0.0260, lasts=0.25)"
        )
        assert sent.wait()


# -------------------------------------------------------------------- while it is waited for
@both()
async def test_a_line_that_is_lost_or_closed_ends_the_wait(controller: Any, line: Any) -> None:
    over = await controller.move_servos([(1, 800)], 10)
    await over.wait()
    motion = await controller.move_servos([(1, 800)], 1000)
    line.unplug()
    with pytest.raises(DisconnectedError, match="the line was lost"):
        await motion.wait()
    await controller.close()
    with pytest.raises(ClosedError):
        await motion.wait()
    assert await over.wait(), "it had ended before"


def test_a_motion_is_waited_for_while_others_talk() -> None:
    with ThreadPoolExecutor() as pool, busservo.Controller(LiveLine(), **LIVE) as controller:
        motions = [controller.move_servos([(servo, 800)], 50) for servo in range(1, 5)]
        pending = [pool.submit(motion.wait) for motion in motions]
        assert controller.read_battery_voltage() == 7500
        assert [each.result(GENEROUS) for each in pending] == [True] * 4
        assert all(motion.remaining == 0.0 for motion in motions)


@in_turn("error", lambda: [DisconnectedError, ClosedError])
@in_turn("latest", lambda: [False, True])
@in_virtual_time
async def test_in_a_task_a_line_that_is_lost_or_closed_meanwhile_ends_the_wait(
    latest: bool, error: type[Exception]
) -> None:
    line = VirtualLine()
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


@in_virtual_time
async def test_a_wait_that_is_cancelled_leaves_the_line_usable() -> None:
    async with client(VirtualLine(answered), **LIVE) as controller:
        motion = await controller.move_servos([(1, 800)], LONG)
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(motion.wait(), 0.01)
        assert await controller.read_battery_voltage() == 7500


# -------------------------------------------------------------------- of which the latest wins
@both()
async def test_the_latest_move_takes_the_place_of_what_waits(controller: Any, line: Any) -> None:
    first, second, third = [
        await controller.move_servos([(1, position)], 100, latest=True) for position in (10, 20, 30)
    ]
    other = await controller.move_servos([(2, 40)], 100, latest=True)
    assert line.now == 0, "none of them waits for the line"
    assert first.ends_at == pytest.approx(MOVE + 0.1)
    assert (second.ends_at, second.remaining, second.replaced) == (None, None, True)
    assert (third.ends_at, third.remaining, third.replaced) == (None, None, False)
    assert third.delay == pytest.approx(MOVE)
    assert not await second.wait()
    assert line.now == 0
    assert await third.wait()
    assert line.now == pytest.approx(2 * MOVE + 0.1, abs=0.001)
    assert await other.wait()
    assert line.received == [ServoMove(100, [each]) for each in [(1, 10), (1, 30), (2, 40)]]
    assert controller.counters.replaced == 1
