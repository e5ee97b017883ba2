"""The promises of both clients, each told once; and those of one to the threads that share it."""

from __future__ import annotations

import logging
import math
import os
import pickle
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from inspect import signature
from pathlib import Path
from typing import TYPE_CHECKING, Any

import busservo
import framewire
import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupRun,
    ActionGroupStarted,
    ActionGroupStop,
    ActionGroupStopped,
    AsyncController,
    BatteryVoltageRead,
    ClosedError,
    Controller,
    DisconnectedError,
    EncodeError,
    IncompleteReplyError,
    Message,
    NoReplyError,
    NoReportError,
    ServoMove,
    ServoPositions,
    ServoPositionsRead,
    ServoUnload,
    TransportError,
    open_async_controller,
    open_controller,
)
from busservo.__main__ import main

from tests.in_turn import in_turn
from tests.lines.both_clients import both, by_threads
from tests.lines.live_line import LiveLine, answered
from tests.lines.receiving import unanswered
from tests.lines.timed_line import ScriptedLine, client_on
from tests.lines.virtual_line import VirtualLine
from tests.programs import ran
from tests.timeouts import GENEROUS, LIVE, await_that

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.lines.both_clients import Talk

HEAVY = {"typing", "logging", "threading", "serial", "asyncio"}
STARTED, STOPPED = ActionGroupStarted(8, 1), ActionGroupStopped()
COMPLETED = ActionGroupCompleted(8, 1)
SIX = [(servo, 500) for servo in range(1, 7)]


def test_both_clients_have_the_same_methods() -> None:
    def public(kind: type) -> set[str]:
        return {name for name in dir(kind) if not name.startswith("_")}

    assert public(Controller) == public(AsyncController)


def test_both_are_opened_with_the_same_defaults() -> None:
    def defaults(opening: Callable[..., Any]) -> dict[str, Any]:
        return {each.name: each.default for each in signature(opening).parameters.values()}

    assert defaults(open_controller) == defaults(open_async_controller)


# -------------------------------------------------------------------- commands and questions


@both
def test_the_methods_of_the_spec(talk: Talk) -> None:
    line = VirtualLine(answered)

    async def work(controller: Any) -> None:
        await controller.move_servos([(1, 800), (9, 800)], time_ms=800)
        await controller.run_action_group(8, times=1)
        await controller.stop_action_group()
        await controller.set_action_group_speed(0xFF, percent=300)
        assert await controller.read_battery_voltage() == 7500
        await controller.unload_servos([1, 2, 3])
        assert await controller.read_servo_positions([1, 2]) == ((1, 10), (2, 20))

    talk(line, work)
    assert line.received == [
        ServoMove(time_ms=800, targets=[(1, 800), (9, 800)]),
        ActionGroupRun(8, 1),
        ActionGroupStop(),
        line.received[3],
        BatteryVoltageRead(),
        ServoUnload([1, 2, 3]),
        ServoPositionsRead([1, 2]),
    ]
    assert line.closed


@both
@in_turn("count", lambda: [1, 84, 85, 168, 200])
def test_positions_are_requested_in_parts(talk: Talk, count: int) -> None:
    line, servos = VirtualLine(answered), range(1, count + 1)

    async def work(controller: Any) -> None:
        found = await controller.read_servo_positions(servos)
        assert found == tuple((servo, 10 * servo) for servo in servos)

    talk(line, work)
    sizes = [len(each.servo_ids) for each in line.received if isinstance(each, ServoPositionsRead)]
    assert sizes == [min(84, count - at) for at in range(0, count, 84)]


NO_LISTS: list[tuple[Any, str]] = [
    *((each, "servo_ids") for each in ([], iter(()), [256], ["1"], 5, "12", [True])),
    # A wrong element is named by its place in the whole list.
    ([*range(100), 300], r"servo_ids\[100\]: 300 is outside 0\.\.255"),
]


@both
@in_turn("wrong, problem", lambda: NO_LISTS)
def test_a_question_that_no_frame_carries_is_refused_before_anything_is_sent(
    talk: Talk, wrong: Any, problem: str
) -> None:
    line = VirtualLine(answered)

    async def work(controller: Any) -> None:
        with pytest.raises(EncodeError, match=problem):
            await controller.read_servo_positions(wrong)

    talk(line, work)
    assert line.received == []


@both
def test_what_did_not_arrive_is_named_and_what_did_is_kept(talk: Talk) -> None:
    def answer(message: Message) -> list[Message]:
        assert isinstance(message, ServoPositionsRead)
        there = [servo for servo in message.servo_ids if servo not in (3, 100)]
        return [ServoPositions([(servo, 500) for servo in there])]

    async def work(controller: Any) -> None:
        with pytest.raises(IncompleteReplyError, match=r"servo_ids 3, 100; .*98") as caught:
            await controller.read_servo_positions(range(1, 101))
        assert caught.value.missing == (3, 100)
        assert len(caught.value.arrived) == 98
        assert len(caught.value.replies) == 2

    talk(VirtualLine(answer), work)


@both
def test_a_question_of_one_request_names_what_is_missing_from_its_reply(talk: Talk) -> None:
    """As for a protocol whose replies have room for all that can be requested at once."""

    async def work(controller: Any) -> None:
        with pytest.raises(IncompleteReplyError) as caught:
            await controller._ask(ServoPositionsRead([1, 2, 3]), ServoPositions)
        assert caught.value.missing == (1, 3)
        assert caught.value.arrived == ((2, 20),)

    async def mistake(controller: Any) -> None:
        with pytest.raises(TypeError, match="is answered by BatteryVoltage"):
            await controller._ask(BatteryVoltageRead(), ServoPositions)

    talk(VirtualLine(lambda _: [ServoPositions([(2, 20)])]), work)
    talk(VirtualLine(answered), mistake)


@both
def test_retries_are_off_by_default_and_only_for_questions(talk: Talk) -> None:
    line = VirtualLine()

    async def work(controller: Any) -> None:
        with pytest.raises(NoReplyError) as late:
            await controller.read_battery_voltage()
        assert 0.05 <= late.value.waited < 1
        assert len(line.received) == 1
        with pytest.raises(NoReplyError, match="to 3 requests"):
            await controller.request(BatteryVoltageRead(), retries=2)
        assert len(line.received) == 4
        await controller.move_servos([(1, 500)], 100)
        assert len(line.received) == 5

    talk(line, work, reply_timeout=0.05)


@both
def test_send_and_request_know_commands_from_questions(talk: Talk) -> None:
    async def work(controller: Any) -> None:
        with pytest.raises(TypeError, match="is a question"):
            await controller.send(BatteryVoltageRead())
        with pytest.raises(TypeError, match="is a question"):
            controller.send_latest(BatteryVoltageRead())
        with pytest.raises(TypeError, match="is a command"):
            await controller.request(ActionGroupStop())
        assert await controller.read_battery_voltage() == 7500

    talk(VirtualLine(answered), work)


@both
def test_moves_faster_than_the_line_do_not_pile_up(talk: Talk) -> None:
    line = VirtualLine()

    async def work(controller: Any) -> None:
        for _ in range(20):
            sent = await controller.move_servos(SIX, 20)
            assert sent.delay < 0.005
            assert sent.duration == pytest.approx(25 / 960)
        assert line.now == pytest.approx(19 * 25 / 960 - 0.004, abs=0.001)

    talk(line, work)


@both
def test_the_latest_move_wins(talk: Talk) -> None:
    line = VirtualLine()

    async def work(controller: Any) -> None:
        for position in range(100):
            controller.send_latest(ServoMove(20, [(1, position)]))
        assert len(line.received) == 1
        assert controller.counters.replaced == 98

    talk(line, work)
    assert line.received == [ServoMove(20, [(1, 0)]), ServoMove(20, [(1, 99)])]


# -------------------------------------------------------------------- reports


@both
def test_reports_come_in_order_and_end_in_silence(talk: Talk) -> None:
    line = VirtualLine()
    said = [STARTED, STOPPED, COMPLETED]

    async def work(controller: Any) -> None:
        for at, report in enumerate(said):
            line.say(report, at * 0.1)
        for expected in (said, []):
            assert [each async for each in controller.reports(timeout=0.5)] == expected

    talk(line, work)


@both
def test_the_oldest_reports_go_when_there_are_too_many(talk: Talk) -> None:
    line = VirtualLine()

    async def work(controller: Any) -> None:
        for times in range(10):
            line.say(ActionGroupCompleted(8, times))
        with pytest.raises(NoReportError):
            await controller.wait_for(ActionGroupStopped, timeout=0.1)
        kept = [report async for report in controller.reports(timeout=0.01)]
        assert kept == [ActionGroupCompleted(8, times) for times in range(6, 10)]
        assert controller.counters.lost_reports == 6

    talk(line, work, report_limit=4)


@both
def test_waiting_for_a_group_to_end(talk: Talk) -> None:
    def answer(message: Message) -> list[Message | tuple[float, Message]]:
        if not isinstance(message, ActionGroupRun):
            return [*answered(message)]
        done = ActionGroupCompleted(message.group, message.times)
        return [ActionGroupStarted(message.group, message.times), (2.0, done)]

    line = VirtualLine(answer)

    async def work(controller: Any) -> None:
        line.say(ActionGroupCompleted(8, 7))
        await controller.run_action_group(9, times=1)
        await controller.run_action_group(8, times=1)
        found = await controller.wait_for(ActionGroupCompleted, group=8, timeout=5)
        assert found == COMPLETED
        # It had ended before anybody waited for it, and counts all the same.
        assert (await controller.wait_for(ActionGroupCompleted, group=9, timeout=5)).group == 9
        began = line.now
        absent = r"no ActionGroupCompleted\(group=8\) came within 3"
        with pytest.raises(NoReportError, match=absent):
            await controller.wait_for(ActionGroupCompleted, group=8, timeout=3)
        assert line.now - began < 3.1

    talk(line, work)


@both
def test_waiting_for_one_of_several_reports(talk: Talk) -> None:
    kinds = (ActionGroupCompleted, ActionGroupStopped)
    line = VirtualLine(lambda _: [STARTED, (1.0, STOPPED)])

    async def work(controller: Any) -> None:
        await controller.run_action_group(8, times=1)
        assert await controller.wait_for(kinds, group=8, timeout=5) == STOPPED
        absent = r"no ActionGroupCompleted\(group=8\) or ActionGroupStopped\(\) came"
        with pytest.raises(NoReportError, match=absent):
            await controller.wait_for(kinds, group=8, timeout=1)

    talk(line, work)


NO_WAITS: list[tuple[Any, dict[str, int], str]] = [
    (ActionGroupCompleted, {"grup": 8}, "has no field 'grup'; it has group, times"),
    (
        (ActionGroupCompleted, ActionGroupStopped),
        {"grup": 8},
        (
            "none of these has a field 'grup': ActionGroupCompleted has group, times; "
            "ActionGroupStopped has none"
        ),
    ),
    *(
        (kind, {}, "no message that comes to this end")
        for kind in (ServoMove, (ActionGroupStopped, ServoMove), Message)
    ),
    *((each, {}, "is no class of messages") for each in (7, STOPPED, (STOPPED,))),
    ((), {}, "give one"),
]


@both
@in_turn("kind, fields, problem", lambda: NO_WAITS)
def test_waiting_for_what_can_never_come_is_refused(
    talk: Talk, kind: Any, fields: dict[str, int], problem: str
) -> None:
    async def work(controller: Any) -> None:
        with pytest.raises(TypeError, match=problem):
            await controller.wait_for(kind, timeout=1, **fields)

    talk(VirtualLine(), work)


@both
def test_a_missing_report_is_an_error_that_names_what_came_instead(talk: Talk) -> None:
    line = VirtualLine()

    async def work(controller: Any) -> None:
        with pytest.raises(NoReportError, match="what came instead: no report at all"):
            await controller.wait_for(ActionGroupStopped, timeout=1)
        await controller.run_action_group(8, times=1)
        for report in (STARTED, STOPPED, STARTED):
            line.say(report)
        with pytest.raises(NoReportError) as caught:
            await controller.wait_for(ActionGroupCompleted, group=8, timeout=3)
        assert str(caught.value).endswith(
            "instead: 2 times ActionGroupStarted(group=8, times=1), ActionGroupStopped()"
        )
        assert caught.value.instead == {STARTED: 2, STOPPED: 1}
        again = pickle.loads(pickle.dumps(caught.value))  # noqa: S301 - it is ours
        assert (str(again), again.instead) == (str(caught.value), caught.value.instead)
        for group in range(10, 16):
            line.say(ActionGroupStarted(group, 1))
        with pytest.raises(NoReportError, match=r"instead: 4 others, .*12.*13.*14.*15, times=1\)$"):
            await controller.wait_for(ActionGroupCompleted, group=8, timeout=3)

    talk(line, work)


@both
def test_a_callback_that_fails_affects_no_other_and_can_be_removed(
    talk: Talk, caplog: pytest.LogCaptureFixture
) -> None:
    line = VirtualLine()

    async def work(controller: Any) -> None:
        received: list[Message] = []
        controller.on_report(lambda _: 1 / 0)
        stop = controller.on_report(received.append)
        line.say(STOPPED)
        assert await controller.wait_for(ActionGroupStopped, timeout=1) == STOPPED
        assert received == [STOPPED]
        stop()
        stop()  # what has been ended may be ended again
        line.say(COMPLETED)
        await controller.wait_for(ActionGroupCompleted, timeout=1)
        assert received == [STOPPED]

    talk(line, work)
    assert caplog.text.count("ZeroDivisionError") == 2


# -------------------------------------------------------------------- its end


@both
def test_close_waits_until_the_last_byte_is_out(talk: Talk) -> None:
    line = VirtualLine()

    async def work(controller: Any) -> None:
        await controller.move_servos([(servo, 500) for servo in range(1, 60)], 100)
        assert line.now < 0.01
        await controller.close()
        assert line.now >= (7 + 59 * 3) / 960 - 1e-6
        assert line.drained
        assert line.closed
        await controller.close()
        with pytest.raises(ClosedError, match="open it again"):
            await controller.stop_action_group()

    talk(line, work)


def lost(line: VirtualLine) -> None:
    line.error = BrokenPipeError("nobody there")


@both
@in_turn("end", lambda: [VirtualLine.unplug, lost])
def test_a_lost_line_says_so_until_it_is_opened_again(
    talk: Talk, end: Callable[[VirtualLine], None]
) -> None:
    line = VirtualLine(answered)

    async def work(controller: Any) -> None:
        shown = repr(controller).replace("Async", "")
        assert shown == "<Controller on virtual line, open>"
        await controller.stop_action_group()
        end(line)
        with pytest.raises(DisconnectedError, match=r"plug it in again|nobody there"):
            await controller.stop_action_group()
        assert repr(controller).endswith(", failed>")
        with pytest.raises(DisconnectedError):
            _ = [each async for each in controller.reports()]
        await controller.reconnect()
        assert await controller.read_battery_voltage() == 7500
        await controller.close()
        assert repr(controller).endswith(", closed>")
        with pytest.raises(ClosedError):
            await controller.reconnect()

    talk(line, work)


@both
def test_a_client_that_was_never_used_can_be_closed(talk: Talk) -> None:
    async def work(_: object) -> None:
        pass

    line = VirtualLine()
    talk(line, work)
    assert line.closed


def test_a_line_that_cannot_be_opened_again_says_so() -> None:
    controller = client_on(ScriptedLine(lambda _: b""), Controller)
    with pytest.raises(TypeError, match="no method reopen"):
        controller.reconnect()
    controller.close()


def test_errors_are_of_one_family() -> None:
    error = TransportError("COM7", "it is in use", "close the other program")
    assert isinstance(error, OSError)
    assert str(error) == "COM7: it is in use; close the other program"
    assert str(error.again()) == str(error)


# -------------------------------------------------------------------- what it tells


@both
def test_every_frame_is_logged_and_traced(
    talk: Talk,
    tmp_path: Path,
    caplog: pytest.LogCaptureFixture,
    capsys: pytest.CaptureFixture[str],
) -> None:
    line, trace = VirtualLine(answered), tmp_path / "line.log"
    caplog.set_level(logging.DEBUG, "busservo")

    async def work(controller: Any) -> None:
        line.say(b"\x55\x00" + STOPPED.encode())
        assert await controller.read_battery_voltage() == 7500
        await controller.stop_action_group()

    talk(line, work, trace=trace)
    assert "virtual line > BatteryVoltageRead() | 55 55 02 0F" in caplog.text
    assert "virtual line < BatteryVoltage(voltage_mv=7500) | 55 55 04 0F 4C 1D" in caplog.text
    assert "virtual line < bad header | 55 00" in caplog.text
    assert main(["decode", "--direction", "any", str(trace)]) == 0
    shown = capsys.readouterr()
    assert "BatteryVoltageRead" in shown.out
    assert "BatteryVoltage voltage_mv=7500 mV" in shown.out
    assert "4 messages, 2 bytes of noise" in shown.err


def test_a_long_trace_is_read_back(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    async def work(controller: Any) -> None:
        for _ in range(600):
            await controller.read_battery_voltage()

    trace = tmp_path / "line.log"
    by_threads(VirtualLine(answered), work, trace=trace, baud=math.inf)
    text = trace.read_bytes().replace(b"#", b"#" * 3)
    for pad in range(3):
        # Wherever the first 64 KiB end: in a comment, or between the two digits of a byte.
        trace.write_bytes(b"#" * pad + b"\n" + text)
        assert main(["decode", str(trace)]) == 0
        assert "1200 messages, 0 bytes of noise" in capsys.readouterr().err


@both
def test_nothing_is_logged_by_default(talk: Talk, caplog: pytest.LogCaptureFixture) -> None:
    async def work(controller: Any) -> None:
        await controller.read_battery_voltage()

    talk(VirtualLine(answered), work)
    assert [each for each in caplog.records if each.name == "busservo"] == []


def test_the_codec_imports_no_client() -> None:
    def loaded(code: str) -> str:
        shown = f"{code}; import sys; print(sorted({HEAVY} & set(sys.modules)))"
        folders = [Path(str(each.__file__)).parents[1] for each in (busservo, framewire)]
        path = {"PYTHONPATH": os.pathsep.join(map(str, folders))}
        return ran(sys.executable, "-S", "-c", shown, environment=path).stdout

    assert loaded("import busservo") == loaded("pass")
    assert "asyncio" not in loaded("import busservo; busservo.Controller")


@both
def test_the_repr_of_a_line_shows_its_statistics(talk: Talk) -> None:
    async def work(controller: Any) -> None:
        sent = await controller.send(ActionGroupStop())
        assert repr(sent) == "Sent(ActionGroupStop(), delay=0.0000, duration=0.0042)"
        await controller.read_battery_voltage()
        assert repr(controller.counters) == (
            "LineCounters(echoes=0, impossible=1, lost_reports=0, noise=0, replaced=0, replies=1, "
            "reports=0, retries=0, sent=2, timeouts=0, unsolicited=0)"
        )

    talk(VirtualLine(answered), work)


# -------------------------------------------------------------------- threads


def test_callbacks_may_use_the_client_for_threads() -> None:
    line = VirtualLine(answered)
    with client_on(line, Controller) as controller:
        received: list[object] = []
        controller.on_report(
            lambda report: received.append((report, controller.read_battery_voltage()))
        )
        line.say(STOPPED)
        line.say(COMPLETED)
        assert controller.read_battery_voltage() == 7500
        assert received == [(STOPPED, 7500), (COMPLETED, 7500)]


def test_the_thread_that_listens_is_named_after_the_line() -> None:
    line = LiveLine()
    with Controller(line, **LIVE) as controller:
        controller.read_battery_voltage()
        assert f"busservo on {line.name}" in [thread.name for thread in threading.enumerate()]


def test_eight_threads_share_a_controller() -> None:
    line = LiveLine()
    with Controller(line, **LIVE) as controller, ThreadPoolExecutor(8) as pool:

        def work(number: int) -> None:
            for turn in range(40):
                servos = [number + 1, 10 * (number + 1)]
                assert controller.read_servo_positions(servos) == tuple((s, 10 * s) for s in servos)
                controller.move_servos([(number, turn)], 100)
                line.say(ActionGroupCompleted(number, turn))

        list(pool.map(work, range(8)))
        said = {(number, turn) for number in range(8) for turn in range(40)}
        await_that(lambda: controller.counters.reports >= 320)
        received = list(controller.reports(timeout=0.02))
        assert {
            (each.group, each.times) for each in received if isinstance(each, ActionGroupCompleted)
        } == said
        assert len(received) == 320
    assert controller.counters.unsolicited == 0
    assert line.drained == len(line.received) == 640


def test_a_report_reaches_a_callback_while_somebody_waits_for_another() -> None:
    line = LiveLine()
    received: list[Message] = []
    with Controller(line, **LIVE) as controller, ThreadPoolExecutor(1) as pool:
        controller.on_report(received.append)
        pending = pool.submit(controller.wait_for, ActionGroupCompleted, timeout=GENEROUS)
        line.say(STARTED)
        await_that(lambda: received == [STARTED])
        assert not pending.done()
        line.say(COMPLETED)
        assert pending.result(GENEROUS) == COMPLETED


def test_a_report_reaches_a_callback_without_any_call() -> None:
    line = LiveLine()
    with Controller(line) as controller:
        received = threading.Event()
        controller.on_report(lambda _: received.set())
        line.say(STOPPED)
        assert received.wait(GENEROUS)


def test_unplugged_while_a_question_is_under_way() -> None:
    line = LiveLine(unanswered)
    with Controller(line, **LIVE) as controller, ThreadPoolExecutor(1) as pool:
        asking = pool.submit(controller.read_battery_voltage)
        await_that(lambda: line.received)
        line.unplug()
        with pytest.raises(DisconnectedError, match="plug it in again"):
            asking.result(GENEROUS)


def test_close_ends_the_waits_of_other_threads() -> None:
    line = LiveLine(unanswered)
    controller = Controller(line, **LIVE)
    with ThreadPoolExecutor(3) as pool:
        asking = pool.submit(controller.read_battery_voltage)
        listening = pool.submit(lambda: list(controller.reports()))
        pending = pool.submit(controller.wait_for, ActionGroupStopped, timeout=GENEROUS)
        await_that(lambda: line.received)
        controller.close()
        with pytest.raises(ClosedError):
            asking.result(GENEROUS)
        assert listening.result(GENEROUS) == []
        with pytest.raises(ClosedError):
            pending.result(GENEROUS)
