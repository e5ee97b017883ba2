"""The promises of both clients, each told once; and those of one to the threads that share it."""

import logging
import math
import os
import pickle
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from inspect import signature
from pathlib import Path
from typing import Any

import busservo
import framewire
import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupStopped,
    Controller,
    EncodeError,
    Message,
    NoReplyError,
    NoReportError,
)
from busservo.__main__ import main
from busservo.strategies import messages
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.lines.at_board import client_at, virtual_board
from tests.lines.both_clients import both
from tests.lines.live_line import LiveLine, answered
from tests.lines.timed_line import ScriptedLine, client_on
from tests.lines.virtual_line import VirtualLine
from tests.programs import ran
from tests.timeouts import GENEROUS, LIVE, await_that

HEAVY = {"typing", "logging", "threading", "serial", "asyncio"}
STARTED, STOPPED = busservo.ActionGroupStarted(8, 1), ActionGroupStopped()
COMPLETED = ActionGroupCompleted(8, 1)


def test_both_clients_have_the_same_methods_and_defaults() -> None:
    def public(kind: type) -> set[str]:
        return {name for name in dir(kind) if not name.startswith("_")}

    def defaults(opening: Callable[..., Any]) -> dict[str, Any]:
        return {each.name: each.default for each in signature(opening).parameters.values()}

    assert public(Controller) == public(busservo.AsyncController)
    assert defaults(busservo.open_controller) == defaults(busservo.open_async_controller)


# -------------------------------------------------------------------- commands and questions


NO_LISTS: list[tuple[Any, str]] = [
    *((each, "servo_ids") for each in ([], iter(()), [256], ["1"], 5, "12", [True])),
    # A wrong element is named by its place in the whole list.
    ([*range(100), 300], r"servo_ids\[100\]: 300 is outside 0\.\.255"),
]


@in_turn("wrong, problem", lambda: NO_LISTS)
@both(answered)
async def test_a_question_that_no_frame_carries_is_refused_before_anything_is_sent(
    controller: Any, line: Any, wrong: Any, problem: str
) -> None:
    with pytest.raises(busservo.EncodeError, match=problem):
        await controller.read_servo_positions(wrong)
    assert line.received == []


def without_some(message: Message) -> list[Message]:
    assert isinstance(message, busservo.ServoPositionsRead)
    there = [servo for servo in message.servo_ids if servo not in (3, 100)]
    return [busservo.ServoPositions([(servo, 500) for servo in there])]


@both(without_some)
async def test_what_did_not_arrive_is_named_and_what_did_is_kept(controller: Any) -> None:
    with pytest.raises(busservo.IncompleteReplyError, match=r"servo_ids 3, 100; .*98") as caught:
        await controller.read_servo_positions(range(1, 101))
    assert caught.value.missing == (3, 100)
    assert len(caught.value.arrived) == 98
    assert len(caught.value.replies) == 2
    # As for a protocol whose replies have room for all that can be requested at once.
    with pytest.raises(busservo.IncompleteReplyError) as caught:
        await controller._ask(busservo.ServoPositionsRead([1, 2, 3]), busservo.ServoPositions)
    assert (caught.value.missing, caught.value.arrived) == ((3,), ((1, 500), (2, 500)))


@both()
async def test_retries_are_off_by_default_and_only_for_questions(
    controller: Any, line: Any
) -> None:
    with pytest.raises(busservo.NoReplyError) as late:
        await controller.read_battery_voltage()
    assert 0.25 <= late.value.waited < 1
    assert len(line.received) == 1
    with pytest.raises(busservo.NoReplyError, match="to 3 requests"):
        await controller.request(busservo.BatteryVoltageRead(), retries=2)
    assert len(line.received) == 4
    await controller.move_servos([(1, 500)], 100)
    assert len(line.received) == 5
    assert (controller.counters.timeouts, controller.counters.retries) == (4, 2)


@both(answered)
async def test_send_and_request_know_commands_from_questions(controller: Any) -> None:
    with pytest.raises(TypeError, match="is a question"):
        await controller.send(busservo.BatteryVoltageRead())
    with pytest.raises(TypeError, match="is a question"):
        controller.send_latest(busservo.BatteryVoltageRead())
    with pytest.raises(TypeError, match="is a command"):
        await controller.request(busservo.ActionGroupStop())
    with pytest.raises(TypeError, match="is answered by BatteryVoltage"):
        await controller._ask(busservo.BatteryVoltageRead(), busservo.ServoPositions)
    assert await controller.read_battery_voltage() == 7500


# -------------------------------------------------------------------- reports
@both(report_limit=4)
async def test_the_oldest_reports_go_when_there_are_too_many(controller: Any, line: Any) -> None:
    said = [ActionGroupCompleted(8, times) for times in range(10)]
    for each in said:
        line.say(each)
    with pytest.raises(NoReportError):
        await controller.wait_for(ActionGroupStopped, timeout=0.1)
    assert [report async for report in controller.reports(timeout=0.01)] == said[6:]
    assert controller.counters.lost_reports == 6


def of_groups(message: Message) -> list[Message | tuple[float, Message]]:
    """Run any group for two seconds; group 7 is then stopped."""
    if not isinstance(message, busservo.ActionGroupRun):
        return [*answered(message)]
    done = ActionGroupCompleted(message.group, message.times) if message.group != 7 else STOPPED
    return [busservo.ActionGroupStarted(message.group, message.times), (2.0, done)]


@both(of_groups)
async def test_waiting_for_a_group_to_end(controller: Any, line: Any) -> None:
    line.say(ActionGroupCompleted(8, 7))
    await controller.run_action_group(9, times=1)
    await controller.run_action_group(8, times=1)
    found = await controller.wait_for(ActionGroupCompleted, group=8, timeout=5)
    assert found == COMPLETED
    # It had ended before anybody waited for it, and counts all the same.
    assert (await controller.wait_for(ActionGroupCompleted, group=9, timeout=5)).group == 9
    began = line.now
    with pytest.raises(NoReportError, match=r"no ActionGroupCompleted\(group=8\) came within 3"):
        await controller.wait_for(ActionGroupCompleted, group=8, timeout=3)
    assert line.now - began < 3.1
    kinds = (ActionGroupCompleted, ActionGroupStopped)
    await controller.run_action_group(7, times=1)
    assert await controller.wait_for(kinds, group=7, timeout=5) == STOPPED
    absent = r"no ActionGroupCompleted\(group=7\) or ActionGroupStopped\(\) came"
    with pytest.raises(NoReportError, match=absent):
        await controller.wait_for(kinds, group=7, timeout=1)


NO_WAITS: list[tuple[Any, dict[str, int], str]] = [
    (ActionGroupCompleted, {"grup": 8}, "has no field 'grup'; it has group, times"),
    (
        (ActionGroupCompleted, ActionGroupStopped),
        {"grup": 8},
        "none of these has a field 'grup': ActionGroupCompleted has group, times; ActionGroupSt",
    ),
    (busservo.ServoMove, {}, "^ServoMove is no message that comes to this end"),
    ((ActionGroupStopped, busservo.ServoMove), {}, "no message that comes to this end"),
    (Message, {}, "no message that comes to this end"),
    *((each, {}, "is no class of messages") for each in (7, STOPPED, (STOPPED,))),
    ((), {}, "give one"),
]


@in_turn("kind, fields, problem", lambda: NO_WAITS)
@both()
async def test_waiting_for_what_can_never_come_is_refused(
    controller: Any, kind: Any, fields: dict[str, int], problem: str
) -> None:
    with pytest.raises(TypeError, match=problem):
        await controller.wait_for(kind, timeout=1, **fields)


@both()
async def test_a_missing_report_is_an_error_that_names_what_came_instead(
    controller: Any, line: Any
) -> None:
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
        line.say(busservo.ActionGroupStarted(group, 1))
    with pytest.raises(NoReportError, match=r"instead: 4 others, .*12.*13.*14.*15, times=1\)$"):
        await controller.wait_for(ActionGroupCompleted, group=8, timeout=3)


@both()
async def test_a_callback_that_fails_affects_no_other_and_can_be_removed(
    controller: Any, line: Any, caplog: pytest.LogCaptureFixture
) -> None:
    received: list[Message] = []
    controller.on_report(lambda _: 1 / 0)
    stop = controller.on_report(received.append)
    line.say(STOPPED)
    assert await controller.wait_for(ActionGroupStopped, timeout=1) == STOPPED
    assert received == [STOPPED]
    again = controller.on_report(received.append)
    stop()
    stop()  # what has been ended may be ended again, and ends no other
    line.say(STOPPED)
    assert await controller.wait_for(ActionGroupStopped, timeout=1) == STOPPED
    assert received == [STOPPED, STOPPED]
    again()
    line.say(COMPLETED)
    await controller.wait_for(ActionGroupCompleted, timeout=1)
    assert received == [STOPPED, STOPPED]
    assert caplog.text.count("ZeroDivisionError") == 3


# -------------------------------------------------------------------- its end
@both()
async def test_close_waits_until_the_last_byte_is_out(controller: Any, line: Any) -> None:
    await controller.move_servos([(servo, 500) for servo in range(1, 60)], 100)
    assert line.now < 0.01
    await controller.close()
    assert line.now >= (7 + 59 * 3) / 960 - 1e-6
    assert line.drained
    assert line.closed
    await controller.close()
    with pytest.raises(busservo.ClosedError, match="open it again"):
        await controller.stop_action_group()


def lost(line: VirtualLine) -> None:
    line.error = BrokenPipeError("nobody there")


@in_turn("end", lambda: [VirtualLine.unplug, lost])
@both(answered)
async def test_a_lost_line_says_so_until_it_is_opened_again(
    controller: Any, line: Any, end: Callable[[VirtualLine], None]
) -> None:
    assert repr(controller).replace("Async", "") == "<Controller on virtual line, open>"
    await controller.stop_action_group()
    end(line)
    with pytest.raises(busservo.DisconnectedError, match=r"plug it in again|nobody there"):
        await controller.stop_action_group()
    assert repr(controller).endswith(", failed>")
    with pytest.raises(busservo.DisconnectedError):
        _ = [each async for each in controller.reports()]
    await controller.reconnect()
    assert await controller.read_battery_voltage() == 7500
    await controller.close()
    assert repr(controller).endswith(", closed>")
    with pytest.raises(busservo.ClosedError):
        await controller.reconnect()


def test_a_line_that_cannot_be_opened_again_says_so() -> None:
    controller = client_on(ScriptedLine(lambda _: b""), Controller)
    with pytest.raises(TypeError, match="no method reopen"):
        controller.reconnect()
    controller.close()


# -------------------------------------------------------------------- what it tells
@both(answered, trace="line.log")
async def test_every_frame_is_logged_and_traced(
    controller: Any, line: Any, in_a_folder: Path, caplog: Any, capsys: Any
) -> None:
    caplog.set_level(logging.DEBUG, "busservo")
    line.say(b"\x55\x00" + STOPPED.encode())
    assert await controller.read_battery_voltage() == 7500
    await controller.stop_action_group()
    await controller.close()
    assert "virtual line > BatteryVoltageRead() | 55 55 02 0F" in caplog.text
    assert "virtual line < BatteryVoltage(voltage_mv=7500) | 55 55 04 0F 4C 1D" in caplog.text
    assert "virtual line < bad header | 55 00" in caplog.text
    assert main(["decode", "--direction", "any", "line.log"]) == 0
    shown = capsys.readouterr()
    assert "BatteryVoltageRead" in shown.out
    assert "BatteryVoltage voltage_mv=7500 mV" in shown.out
    assert "4 messages, 2 bytes of noise" in shown.err


@pytest.fixture
def in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_codec_imports_no_client() -> None:
    def loaded(code: str) -> str:
        shown = f"{code}; import sys; print(sorted({HEAVY} & set(sys.modules)))"
        folders = [Path(str(each.__file__)).parents[1] for each in (busservo, framewire)]
        path = {"PYTHONPATH": os.pathsep.join(map(str, folders))}
        return ran(sys.executable, "-S", "-c", shown, environment=path).stdout

    assert loaded("import busservo") == loaded("pass")
    assert "asyncio" not in loaded("import busservo; busservo.Controller")


@both(answered)
async def test_statistics_are_shown_and_nothing_is_logged_by_default(
    controller: Any, caplog: pytest.LogCaptureFixture
) -> None:
    sent = await controller.send(busservo.ActionGroupStop())
    assert repr(sent) == "Sent(ActionGroupStop(), delay=0.0000, duration=0.0042)"
    await controller.read_battery_voltage()
    assert repr(controller.counters) == (
        "LineCounters(echoes=0, impossible=1, lost_reports=0, noise=0, replaced=0, replies=1, "
        "reports=0, retries=0, sent=2, timeouts=0, unsolicited=0)"
    )
    assert [each for each in caplog.records if each.name == "busservo"] == []


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
        assert f"busservo on {line.name}" in [thread.name for thread in threading.enumerate()]
        said = {ActionGroupCompleted(number, turn) for number in range(8) for turn in range(40)}
        await_that(lambda: controller.counters.reports >= 320)
        received = list(controller.reports(timeout=0.02))
        assert {*received} == said
        assert len(received) == 320
    assert controller.counters.unsolicited == 0
    assert line.drained == len(line.received) == 640


def test_a_report_reaches_a_callback_while_somebody_waits_for_another_or_nobody_does() -> None:
    line = LiveLine()
    received: list[Message] = []
    with Controller(line, **LIVE) as controller, ThreadPoolExecutor(1) as pool:
        controller.on_report(received.append)
        line.say(STOPPED)
        await_that(lambda: received == [STOPPED])
        pending = pool.submit(controller.wait_for, ActionGroupCompleted, timeout=GENEROUS)
        line.say(STARTED)
        await_that(lambda: received == [STOPPED, STARTED])
        assert not pending.done()
        line.say(COMPLETED)
        assert pending.result(GENEROUS) == COMPLETED


def at(board: Any, **more: Any) -> Any:
    return client_at(board, Controller, baud=math.inf, settle=None, **more)


@given(st.lists(messages(), max_size=20))
def test_any_message_is_sent_whole_or_refused(requests: list[Message]) -> None:
    with virtual_board() as board, at(board, reply_timeout=0.01) as controller:
        sent = 0
        for message in requests:
            for way in (controller.send, controller.request, controller.send_latest):
                try:
                    with suppress(NoReplyError):
                        way(message)
                    sent += 1
                except (TypeError, EncodeError):
                    continue
        controller.close()
        assert board.accepted + controller.counters.replaced == sent
        assert board.rejects.total == 0
