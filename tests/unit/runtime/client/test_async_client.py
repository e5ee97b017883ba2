"""The client for asyncio: its promises to tasks that share it."""

from __future__ import annotations

import asyncio
import gc
import logging
import math
import subprocess
import sys
import time
import warnings
from inspect import signature
from typing import TYPE_CHECKING, Any, TypeVar

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupRun,
    ActionGroupStarted,
    ActionGroupStop,
    ActionGroupStopped,
    AsyncController,
    BatteryVoltage,
    BatteryVoltageRead,
    ClosedError,
    Controller,
    DisconnectedError,
    IncompleteReplyError,
    Message,
    NoReplyError,
    NoReportError,
    ServoMove,
    ServoPositions,
    ServoPositionsRead,
    TransportError,
    open_async_controller,
    open_controller,
)
from busservo._client.base_client import POLL_INTERVAL

from tests.lines.live_line import LiveLine, answered
from tests.lines.loop_line import LoopLine, client, run
from tests.timeouts import GENEROUS, LIVE

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine
    from pathlib import Path

_T = TypeVar("_T")


def run_live(work: Coroutine[object, object, _T]) -> _T:
    """Run a coroutine; no test may wait for ever."""

    async def bounded() -> _T:
        return await asyncio.wait_for(work, 2 * GENEROUS)

    return asyncio.run(bounded())


def silent(_message: Message) -> list[Message]:
    return []


def test_both_clients_have_the_same_methods() -> None:
    def public(kind: type) -> set[str]:
        return {name for name in dir(kind) if not name.startswith("_")}

    assert public(Controller) == public(AsyncController)


def test_both_are_opened_with_the_same_defaults() -> None:
    def defaults(opening: Callable[..., Any]) -> dict[str, Any]:
        return {each.name: each.default for each in signature(opening).parameters.values()}

    assert defaults(open_controller) == defaults(open_async_controller)


def test_the_methods_of_the_spec() -> None:
    line = LiveLine()

    async def work() -> None:
        async with AsyncController(line, **LIVE) as controller:
            await controller.move_servos([(1, 800), (9, 800)], time_ms=800)
            await controller.run_action_group(8, times=1)
            await controller.stop_action_group()
            await controller.set_action_group_speed(0xFF, percent=300)
            assert await controller.read_battery_voltage() == 7500
            await controller.unload_servos([1, 2, 3])
            positions = await controller.read_servo_positions(range(1, 101))
            assert positions == tuple((servo, 10 * servo) for servo in range(1, 101))

    run_live(work())
    assert line.received[:3] == [
        ServoMove(time_ms=800, targets=[(1, 800), (9, 800)]),
        ActionGroupRun(8, 1),
        ActionGroupStop(),
    ]
    assert line.closed


def test_a_hundred_tasks_share_a_controller() -> None:
    line = LiveLine()

    async def work() -> None:
        async with AsyncController(line, baud=math.inf, reply_timeout=GENEROUS) as controller:

            async def ask(number: int) -> None:
                for _ in range(3):
                    servos = [number + 1, number + 2]
                    found = await controller.read_servo_positions(servos)
                    assert found == tuple((s, 10 * s) for s in servos)
                    line.say(ActionGroupCompleted(number, 1))

            await asyncio.gather(*(ask(number) for number in range(100)))
            while controller.counters.reports < 300:
                await asyncio.sleep(0.001)
            received = [report async for report in controller.reports(timeout=0.1)]
            assert len(received) == 300
            assert controller.counters.unsolicited == 0

    run_live(work())


def test_a_cancelled_question_leaves_the_line_usable() -> None:
    requests: list[Message] = []

    def late(message: Message) -> list[Message]:
        requests.append(message)
        return [] if len(requests) == 1 else answered(message)

    line = LoopLine(late)

    async def work() -> None:
        async with client(line, **LIVE) as controller:
            task = asyncio.ensure_future(controller.read_battery_voltage())
            while not requests:
                await asyncio.sleep(0)
            task.cancel()
            with pytest.raises(asyncio.CancelledError):
                await task
            pending = asyncio.ensure_future(controller.read_battery_voltage())
            await asyncio.sleep(0)
            pending.cancel()
            assert await controller.read_servo_positions([1]) == ((1, 10),)
            for report in answered(requests[0]):
                line.say(report)  # the late reply of the first
            assert await controller.read_battery_voltage() == 7500
            assert controller.counters.unsolicited == 1

    run(work(), line)


def test_no_reply_and_too_little_of_one() -> None:
    def partly(message: Message) -> list[Message]:
        return [ServoPositions([(1, 5)])] if isinstance(message, ServoPositionsRead) else []

    async def work() -> None:
        async with client(LoopLine(partly), reply_timeout=0.05) as controller:
            with pytest.raises(NoReplyError) as late:
                await controller.read_battery_voltage()
            assert 0.05 <= late.value.waited < GENEROUS
        async with client(LoopLine(partly), **LIVE) as controller:
            with pytest.raises(IncompleteReplyError) as caught:
                await controller.read_servo_positions([1, 2])
            assert caught.value.missing == (2,)
            with pytest.raises(TypeError, match="is a question"):
                await controller.send(BatteryVoltageRead())
            with pytest.raises(TypeError, match="is a command"):
                await controller.request(ActionGroupStop())

    run(work())


def test_waiting_for_a_group_to_end() -> None:
    def board(message: Message) -> list[Message]:
        if isinstance(message, ActionGroupRun):
            return [ActionGroupStarted(8, 1), ActionGroupCompleted(8, 1)]
        return answered(message)

    async def work() -> None:
        async with client(LoopLine(board), **LIVE) as controller:
            received: list[Message] = []
            controller.on_report(received.append)
            await controller.run_action_group(8, times=1)
            # It has ended before anybody waits for it, and counts all the same.
            assert await controller.read_battery_voltage() == 7500
            assert (
                await controller.wait_for(ActionGroupCompleted, group=8, timeout=GENEROUS)
            ).times == 1
            with pytest.raises(NoReportError, match=r"instead: ActionGroupStarted\(group=8"):
                await controller.wait_for(ActionGroupCompleted, group=8, timeout=0.02)
            await controller.run_action_group(8, times=1)
            ended = await controller.wait_for(
                (ActionGroupStopped, ActionGroupCompleted), group=8, timeout=GENEROUS
            )
            assert ended == ActionGroupCompleted(8, 1)
            assert received == 2 * [ActionGroupStarted(8, 1), ActionGroupCompleted(8, 1)]

    run(work())


def test_the_latest_move_wins() -> None:
    line = LoopLine(silent)

    async def work() -> None:
        async with client(line) as controller:
            for position in range(50):
                controller.send_latest(ServoMove(20, [(1, position)]))
            assert controller.counters.replaced == 48

    run(work(), line)
    assert line.received == [ServoMove(20, [(1, 0)]), ServoMove(20, [(1, 49)])]


def test_unplugged_while_questions_are_under_way() -> None:
    line = LoopLine(silent)

    async def work() -> None:
        async with client(line, **LIVE) as controller:
            tasks = [asyncio.ensure_future(controller.read_battery_voltage()) for _ in range(5)]
            pending = asyncio.ensure_future(
                controller.wait_for(ActionGroupStopped, timeout=GENEROUS)
            )
            await asyncio.sleep(0.02)
            line.unplug()
            for task in [*tasks, pending]:
                with pytest.raises(DisconnectedError):
                    await task
            await controller.reconnect()
            assert not controller.closed
            await controller.stop_action_group()

    run(work(), line)


def test_close_ends_the_waits_of_other_tasks() -> None:
    async def work() -> None:
        controller = client(LoopLine(silent), **LIVE)
        asking = asyncio.ensure_future(controller.read_battery_voltage())
        await asyncio.sleep(0.02)
        await asyncio.gather(controller.close(), controller.close())
        with pytest.raises(ClosedError):
            await asking
        with pytest.raises(ClosedError):
            await controller.stop_action_group()

    run(work())


def test_a_client_that_was_never_used_can_be_closed() -> None:
    line = LoopLine()

    async def work() -> None:
        await client(line).close()

    run(work(), line)
    assert line.closed


def test_a_transport_that_breaks_its_word_ends_in_an_error() -> None:
    class Broken(LiveLine):
        def read(self, timeout: float) -> bytes:
            raise KeyError(timeout)

    async def work() -> None:
        async with AsyncController(Broken(), **LIVE) as controller:
            with pytest.raises(TransportError, match="mend the transport"):
                await controller.read_battery_voltage()

    run_live(work())


def test_every_frame_is_logged_and_traced(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    line = LoopLine()
    trace = tmp_path / "line.log"
    caplog.set_level(logging.DEBUG, "busservo")

    async def work() -> None:
        async with client(line, **LIVE, trace=trace) as controller:
            line.say(ActionGroupStopped())
            assert await controller.read_battery_voltage() == 7500
            await controller.stop_action_group()

    run(work(), line)
    assert "loop line > BatteryVoltageRead() | 55 55 02 0F" in caplog.text
    assert "loop line < BatteryVoltage(voltage_mv=7500) | 55 55 04 0F 4C 1D" in caplog.text
    done = subprocess.run(
        [sys.executable, "-m", "busservo", "decode", "--direction", "any", str(trace)],
        check=True,
        capture_output=True,
        text=True,
    )
    assert "BatteryVoltage voltage_mv=7500 mV" in done.stdout
    assert "4 messages, 0 bytes of noise" in done.stderr


def test_nothing_is_logged_by_default(caplog: pytest.LogCaptureFixture) -> None:
    async def work() -> None:
        async with client(LoopLine(), **LIVE) as controller:
            await controller.read_battery_voltage()

    run(work())
    assert [each for each in caplog.records if each.name == "busservo"] == []


def test_reports_end_when_the_client_is_closed() -> None:
    line = LoopLine()

    async def work() -> None:
        controller = client(line)
        line.say(ActionGroupStopped())

        async def listen() -> list[Message]:
            return [report async for report in controller.reports()]

        listening = asyncio.ensure_future(listen())
        while not controller.counters.reports:
            await asyncio.sleep(0.001)
        await controller.close()
        assert await listening == [ActionGroupStopped()]

    run(work(), line)


def test_the_oldest_reports_go_when_there_are_too_many() -> None:
    line = LoopLine()

    async def work() -> None:
        async with client(line, report_limit=4) as controller:
            for times in range(10):
                line.say(ActionGroupCompleted(8, times))
            while controller.counters.reports < 10:
                await asyncio.sleep(0.001)
            kept = [report async for report in controller.reports(timeout=0.01)]
            assert kept == [ActionGroupCompleted(8, times) for times in range(6, 10)]
            assert controller.counters.lost_reports == 6

    run(work(), line)


def test_moves_faster_than_the_line_do_not_pile_up() -> None:
    line = LoopLine(silent)

    async def work() -> None:
        async with client(line) as controller:
            for _ in range(5):
                sent = await controller.move_servos([(servo, 500) for servo in range(6)], 20)
                assert sent.delay < 0.005
                assert sent.duration == pytest.approx(25 / 960)
            assert line.clock.now() == pytest.approx(4 * 25 / 960 - 0.004)

    run(work(), line)


def test_a_callback_that_fails_affects_no_other_and_can_be_removed(
    caplog: pytest.LogCaptureFixture,
) -> None:
    line = LoopLine()

    async def work() -> None:
        async with client(line) as controller:
            received: list[Message] = []
            controller.on_report(lambda _: 1 / 0)
            stop = controller.on_report(received.append)
            line.say(ActionGroupStopped())
            report = await controller.wait_for(ActionGroupStopped, timeout=GENEROUS)
            assert report == ActionGroupStopped()
            assert received == [ActionGroupStopped()]
            stop()
            stop()  # what has been ended may be ended again
            line.say(ActionGroupCompleted(8, 1))
            await controller.wait_for(ActionGroupCompleted, timeout=GENEROUS)
            assert received == [ActionGroupStopped()]

    run(work(), line)
    assert caplog.text.count("ZeroDivisionError") == 2


def test_a_client_belongs_to_the_loop_in_which_it_was_first_used() -> None:
    async def work() -> None:
        async with AsyncController(LiveLine(), **LIVE) as controller:

            def elsewhere() -> None:
                with pytest.raises(RuntimeError, match="belongs to another event loop"):
                    asyncio.run(controller.stop_action_group())

            await asyncio.get_running_loop().run_in_executor(None, elsewhere)
            assert await controller.read_battery_voltage() == 7500

    run_live(work())


def test_a_question_of_one_request_names_what_is_missing_from_its_reply() -> None:
    """As for a protocol whose replies have room for all that can be requested at once."""

    def partly(_message: Message) -> list[Message]:
        return [ServoPositions([(2, 20)])]

    async def work() -> None:
        async with client(LoopLine(partly), **LIVE) as controller:
            with pytest.raises(IncompleteReplyError) as caught:
                await controller._ask(ServoPositionsRead([1, 2, 3]), ServoPositions)
            assert caught.value.missing == (1, 3)
            assert caught.value.arrived == ((2, 20),)
        async with client(LoopLine(), **LIVE) as controller:
            with pytest.raises(TypeError, match="is answered by BatteryVoltage"):
                await controller._ask(BatteryVoltageRead(), ServoPositions)

    run(work())


def test_a_reply_that_comes_as_its_question_is_cancelled_hurts_nobody() -> None:
    class Counting(LiveLine):
        reads = 0

        def read(self, timeout: float) -> bytes:
            self.reads += 1
            return super().read(timeout)

    line = Counting(silent)

    async def work() -> None:
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

    run_live(work())
    assert line.received == [BatteryVoltageRead(), ActionGroupStop()]


def test_a_report_and_the_end_of_a_motion_come_at_their_time_to_the_moment() -> None:
    line = LoopLine()

    async def work() -> None:
        async with client(line, **LIVE) as controller:
            line.say(ActionGroupCompleted(8, 1), delay=3600.25)
            report = await controller.wait_for(ActionGroupCompleted, timeout=4000)
            assert report == ActionGroupCompleted(8, 1)
            assert line.clock.now() == 3600.25
            motion = await controller.move_servos([(1, 500)], 60_000)
            assert await motion.wait()
            assert line.clock.now() == pytest.approx(3660.25, abs=1e-4)

    run(work(), line)


def test_a_transport_without_notification_is_polled() -> None:
    class Silent(LoopLine):
        on_readable = None  # type: ignore[assignment]

    line = Silent(lambda _: [])

    async def work() -> None:
        async with client(line, reply_timeout=1) as controller:
            line.say(ActionGroupStopped(), delay=0.5)
            await controller.wait_for(ActionGroupStopped, timeout=1)
            assert 0.5 <= line.clock.now() <= 0.5 + POLL_INTERVAL + 1e-4
            with pytest.raises(NoReplyError) as late:
                await controller.read_battery_voltage()
            assert late.value.waited == pytest.approx(1 + 10 / 960, abs=1e-4)

    run(work(), line)


@pytest.mark.parametrize("end", ["read", "write"])
def test_a_line_without_threads_that_is_lost_says_so(end: str) -> None:
    line = LoopLine()

    async def work() -> None:
        async with client(line, **LIVE) as controller:
            await controller.stop_action_group()
            if end == "read":
                line.unplug()
                await asyncio.sleep(0)
                await asyncio.sleep(0)
            else:
                line.lost = True
            with pytest.raises(DisconnectedError, match="plug it in again"):
                await controller.stop_action_group()
            assert "failed" in repr(controller)
            await controller.reconnect()
            assert await controller.read_battery_voltage() == 7500

    run(work(), line)


def test_a_client_without_threads_that_is_forgotten_gives_its_line_back() -> None:
    line = LoopLine()

    async def work() -> None:
        controller = client(line, **LIVE)
        assert await controller.read_battery_voltage() == 7500
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            del controller
            gc.collect()
        assert "loop line was never closed" in str(caught[0].message)
        line.say(ActionGroupStopped())
        await asyncio.sleep(1)

    run(work(), line)
    assert line.closed


def test_what_a_loop_left_open_is_closed_in_another() -> None:
    line = LoopLine()

    async def use() -> AsyncController:
        controller = client(line)
        controller.send_latest(ServoMove(20, [(1, 1)]))
        controller.send_latest(ServoMove(20, [(1, 2)]))
        return controller

    async def close(controller: AsyncController) -> None:
        await controller.close()

    controller = run(use(), line)
    line.say(ActionGroupStopped())
    run(close(controller), line)
    assert line.closed
    assert line.received == [ServoMove(20, [(1, 1)]), ServoMove(20, [(1, 2)])]
