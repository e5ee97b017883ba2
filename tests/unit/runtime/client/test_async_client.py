"""The client for asyncio: its promises to tasks that share it; test_client.py has those of both."""

import asyncio
import gc
import math
import time
import warnings

import busservo
import pytest
from busservo import ActionGroupStopped, AsyncController, BatteryVoltage
from framewire.client.base_client import POLL_INTERVAL

from tests.lines.live_line import LiveLine, answered, in_a_loop
from tests.lines.receiving import unanswered
from tests.lines.virtual_line import VirtualLine, client, in_virtual_time
from tests.timeouts import GENEROUS, LIVE

STOPPED = ActionGroupStopped()


@in_virtual_time
async def test_a_cancelled_question_leaves_the_line_usable() -> None:
    line = VirtualLine(lambda message: answered(message) if len(line.received) > 1 else [])
    async with client(line, **LIVE) as controller:
        task = asyncio.ensure_future(controller.read_battery_voltage())
        while not line.received:
            await asyncio.sleep(0)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        pending = asyncio.ensure_future(controller.read_battery_voltage())
        await asyncio.sleep(0)
        pending.cancel()
        assert await controller.read_servo_positions([1]) == ((1, 10),)
        line.say(BatteryVoltage(7400))  # the late reply of the first
        assert await controller.read_battery_voltage() == 7500
        assert controller.counters.unsolicited == 1


@in_a_loop
async def test_a_client_belongs_to_the_loop_in_which_it_was_first_used() -> None:
    async with AsyncController(LiveLine(), **LIVE) as controller:

        def elsewhere() -> None:
            with pytest.raises(RuntimeError, match="belongs to another event loop"):
                asyncio.run(controller.stop_action_group())

        await asyncio.get_running_loop().run_in_executor(None, elsewhere)
        assert await controller.read_battery_voltage() == 7500


@in_a_loop
async def test_a_reply_that_comes_as_its_question_is_cancelled_hurts_nobody() -> None:
    line = LiveLine(unanswered)
    async with AsyncController(line, reply_timeout=GENEROUS, baud=math.inf) as controller:
        task = asyncio.ensure_future(controller.read_battery_voltage())
        while not line.received:
            await asyncio.sleep(0)
        # The loop stands still meanwhile, so that both are there when it goes on: the reply,
        # and then the end of whoever waited for it.
        line.say(BatteryVoltage(7500))
        before = line.reads
        while line.reads < before + 2:
            time.sleep(0.001)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        assert controller.counters.replies == 1
        await controller.stop_action_group()
    assert line.received == [busservo.BatteryVoltageRead(), busservo.ActionGroupStop()]


@in_virtual_time
async def test_a_report_and_the_end_of_a_motion_come_at_their_time_to_the_moment() -> None:
    line = VirtualLine()
    async with client(line, **LIVE) as controller:
        line.say(STOPPED, delay=3600.25)
        assert await controller.wait_for(ActionGroupStopped, timeout=4000) == STOPPED
        assert line.now == 3600.25
        motion = await controller.move_servos([(1, 500)], 60_000)
        assert await motion.wait()
        assert line.now == pytest.approx(3660.25, abs=1e-4)


@in_virtual_time
async def test_a_transport_without_notification_is_polled() -> None:
    line = VirtualLine()
    line.on_readable = None  # type: ignore[assignment, method-assign]
    async with client(line, reply_timeout=1) as controller:
        line.say(STOPPED, delay=0.5)
        await controller.wait_for(ActionGroupStopped, timeout=1)
        assert 0.5 <= line.now <= 0.5 + POLL_INTERVAL + 1e-4
        with pytest.raises(busservo.NoReplyError) as late:
            await controller.read_battery_voltage()
        assert late.value.waited == pytest.approx(1 + 10 / 960, abs=1e-4)


@in_virtual_time
async def test_a_client_without_threads_that_is_forgotten_gives_its_line_back() -> None:
    line = VirtualLine(answered)
    controller = client(line, **LIVE)
    assert await controller.read_battery_voltage() == 7500
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        del controller
        gc.collect()
    assert "virtual line was never closed" in str(caught[0].message)
    line.say(STOPPED)
    await asyncio.sleep(1)
    assert line.closed
