"""The client for threads: its promises to threads that share it."""

from __future__ import annotations

import logging
import math
import os
import pickle
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING

import busservo
import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupRun,
    ActionGroupStarted,
    ActionGroupStop,
    ActionGroupStopped,
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
)

from tests.lines.live_line import LiveLine, answered
from tests.lines.virtual_line import VirtualLine
from tests.timeouts import GENEROUS, LIVE, await_that

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from busservo._client.report_filter import Kinds

HEAVY = {"typing", "logging", "threading", "serial", "asyncio"}


OPENED: list[Controller] = []


@pytest.fixture(autouse=True)
def all_are_closed() -> Iterator[None]:
    yield
    while OPENED:
        OPENED.pop().close()


def virtual(line: VirtualLine, **settings: object) -> Controller:
    """Return a client of a line in virtual time; closed when the test ends, if not before."""
    made = Controller(line, background=False, clock=line.clock, **settings)  # type: ignore[arg-type]
    OPENED.append(made)
    return made


def at_once(message: Message) -> list[tuple[float, bytes | Message]]:
    return [(0.0, each) for each in answered(message)]


def test_the_methods_of_the_spec() -> None:
    line = VirtualLine(at_once)
    with virtual(line) as controller:
        controller.move_servos([(1, 800), (9, 800)], time_ms=800)
        controller.run_action_group(8, times=1)
        controller.stop_action_group()
        controller.set_action_group_speed(0xFF, percent=300)
        assert controller.read_battery_voltage() == 7500
        controller.unload_servos([1, 2, 3])
        assert controller.read_servo_positions([1, 2]) == ((1, 10), (2, 20))
    assert line.received[:4] == [
        ServoMove(time_ms=800, targets=[(1, 800), (9, 800)]),
        ActionGroupRun(8, 1),
        ActionGroupStop(),
        line.received[3],
    ]
    assert line.received[5:] == [ServoUnload([1, 2, 3]), ServoPositionsRead([1, 2])]
    assert line.closed


@pytest.mark.parametrize("count", [1, 84, 85, 168, 200])
def test_positions_are_requested_in_parts(count: int) -> None:
    line = VirtualLine(at_once)
    servos = range(1, count + 1)
    found = virtual(line).read_servo_positions(servos)
    assert found == tuple((servo, 10 * servo) for servo in servos)
    assert [
        len(each.servo_ids) for each in line.received if isinstance(each, ServoPositionsRead)
    ] == [min(84, count - at) for at in range(0, count, 84)]


@pytest.mark.parametrize("wrong", [[], iter(()), [256], ["1"], 5, "12", [True]])
def test_a_question_that_no_frame_carries_is_refused_before_anything_is_sent(wrong: object) -> None:
    line = VirtualLine(at_once)
    with pytest.raises(EncodeError, match="servo_ids"):
        virtual(line).read_servo_positions(wrong)  # type: ignore[arg-type]
    assert line.received == []


def test_a_wrong_element_is_named_by_its_place_in_the_whole_list() -> None:
    line = VirtualLine(at_once)
    with pytest.raises(EncodeError, match=r"servo_ids\[100\]: 300 is outside 0\.\.255"):
        virtual(line).read_servo_positions([*range(100), 300])
    assert line.received == []


def test_what_did_not_arrive_is_named_and_what_did_is_kept() -> None:
    def answer(message: Message) -> list[tuple[float, bytes | Message]]:
        assert isinstance(message, ServoPositionsRead)
        there = [(servo, 500) for servo in message.servo_ids if servo not in (3, 100)]
        return [(0.0, ServoPositions(there))]

    with pytest.raises(IncompleteReplyError, match=r"servo_ids 3, 100; .*98") as caught:
        virtual(VirtualLine(answer)).read_servo_positions(range(1, 101))
    assert caught.value.missing == (3, 100)
    assert len(caught.value.arrived) == 98
    assert len(caught.value.replies) == 2


def test_retries_are_off_by_default_and_only_for_questions() -> None:
    line = VirtualLine()
    controller = virtual(line)
    with pytest.raises(NoReplyError):
        controller.read_battery_voltage()
    assert len(line.received) == 1
    with pytest.raises(NoReplyError, match="to 3 requests"):
        controller.request(BatteryVoltageRead(), retries=2)
    assert len(line.received) == 4
    controller.move_servos([(1, 500)], 100)
    assert len(line.received) == 5


def test_send_and_request_know_commands_from_questions() -> None:
    controller = virtual(VirtualLine(at_once))
    with pytest.raises(TypeError, match="is a question"):
        controller.send(BatteryVoltageRead())
    with pytest.raises(TypeError, match="is a question"):
        controller.send_latest(BatteryVoltageRead())
    with pytest.raises(TypeError, match="is a command"):
        controller.request(ActionGroupStop())
    assert controller.read_battery_voltage() == 7500


def test_moves_faster_than_the_line_do_not_pile_up() -> None:
    line = VirtualLine()
    controller = virtual(line)
    move = [(servo, 500) for servo in range(1, 7)]
    for _ in range(20):
        sent = controller.move_servos(move, 20)
        assert sent.delay < 0.005
        assert sent.duration == pytest.approx(25 / 960)
    assert line.now == pytest.approx(19 * 25 / 960, abs=0.03)


def test_the_latest_move_wins() -> None:
    line = VirtualLine()
    controller = virtual(line)
    for position in range(100):
        controller.send_latest(ServoMove(20, [(1, position)]))
    assert len(line.received) == 1
    controller.close()
    assert line.received == [ServoMove(20, [(1, 0)]), ServoMove(20, [(1, 99)])]
    assert controller.counters.replaced == 98


def test_close_waits_until_the_last_byte_is_out() -> None:
    line = VirtualLine()
    controller = virtual(line)
    controller.move_servos([(servo, 500) for servo in range(1, 60)], 100)
    assert line.now < 0.01
    controller.close()
    assert line.now >= (7 + 59 * 3) / 960 - 1e-6
    assert line.drained
    assert line.closed
    controller.close()
    with pytest.raises(ClosedError, match="open it again"):
        controller.stop_action_group()


def test_reports_come_in_order_and_end_in_silence() -> None:
    line = VirtualLine(at_once)
    controller = virtual(line)
    said = [ActionGroupStarted(8, 1), ActionGroupStopped(), ActionGroupCompleted(8, 1)]
    for at, report in enumerate(said):
        line.say(report, at * 0.1)
    assert list(controller.reports(timeout=0.5)) == said
    assert list(controller.reports(timeout=0.5)) == []


def test_waiting_for_a_group_to_end() -> None:
    def answer(message: Message) -> list[tuple[float, bytes | Message]]:
        assert isinstance(message, ActionGroupRun)
        done = ActionGroupCompleted(message.group, message.times)
        return [(0.0, ActionGroupStarted(message.group, message.times)), (2.0, done)]

    line = VirtualLine(answer)
    line.say(ActionGroupCompleted(8, 7))
    controller = virtual(line)
    controller.run_action_group(9, times=1)
    controller.run_action_group(8, times=1)
    found = controller.wait_for(ActionGroupCompleted, group=8, timeout=5)
    assert found == ActionGroupCompleted(8, 1)
    assert controller.wait_for(ActionGroupCompleted, group=9, timeout=5).group == 9
    began = line.now
    with pytest.raises(NoReportError, match=r"no ActionGroupCompleted\(group=8\) came within 3"):
        controller.wait_for(ActionGroupCompleted, group=8, timeout=3)
    assert line.now - began < 3.1


def test_waiting_for_what_can_never_come_is_refused() -> None:
    controller = virtual(VirtualLine())
    with pytest.raises(TypeError, match="has no field 'grup'; it has group, times"):
        controller.wait_for(ActionGroupCompleted, grup=8, timeout=1)
    with pytest.raises(
        TypeError,
        match="none of these has a field 'grup': ActionGroupCompleted has group, times; "
        "ActionGroupStopped has none",
    ):
        controller.wait_for((ActionGroupCompleted, ActionGroupStopped), grup=8, timeout=1)
    foreign: list[Kinds] = [ServoMove, (ActionGroupStopped, ServoMove), Message]
    for kind in foreign:
        with pytest.raises(TypeError, match="no message that comes to this end"):
            controller.wait_for(kind, timeout=1)
    wrong: list[Any] = [7, ActionGroupStopped(), (ActionGroupStopped(),)]
    for each in wrong:
        with pytest.raises(TypeError, match="is no class of messages"):
            controller.wait_for(each, timeout=1)
    with pytest.raises(TypeError, match="give one"):
        controller.wait_for((), timeout=1)


def test_waiting_for_one_of_several_reports() -> None:
    def answer(message: Message) -> list[tuple[float, bytes | Message]]:
        return [(0.0, ActionGroupStarted(8, 1)), (1.0, ActionGroupStopped())]

    controller = virtual(VirtualLine(answer))
    controller.run_action_group(8, times=1)
    ended: ActionGroupCompleted | ActionGroupStopped = controller.wait_for(
        (ActionGroupCompleted, ActionGroupStopped), group=8, timeout=5
    )
    assert ended == ActionGroupStopped()
    with pytest.raises(
        NoReportError,
        match=r"no ActionGroupCompleted\(group=8\) or ActionGroupStopped\(\) came",
    ):
        controller.wait_for((ActionGroupCompleted, ActionGroupStopped), group=8, timeout=1)


def test_a_missing_report_is_an_error_that_names_what_came_instead() -> None:
    line = VirtualLine()
    controller = virtual(line)
    with pytest.raises(NoReportError, match="what came instead: no report at all"):
        controller.wait_for(ActionGroupStopped, timeout=1)
    controller.run_action_group(8, times=1)
    for report in (ActionGroupStarted(8, 1), ActionGroupStopped(), ActionGroupStarted(8, 1)):
        line.say(report)
    with pytest.raises(NoReportError) as caught:
        controller.wait_for(ActionGroupCompleted, group=8, timeout=3)
    assert str(caught.value).endswith(
        "what came instead: 2 times ActionGroupStarted(group=8, times=1), ActionGroupStopped()"
    )
    assert caught.value.instead == {ActionGroupStarted(8, 1): 2, ActionGroupStopped(): 1}
    again = pickle.loads(pickle.dumps(caught.value))  # noqa: S301 - it is ours
    assert (str(again), again.instead) == (str(caught.value), caught.value.instead)
    for group in range(10, 16):
        line.say(ActionGroupStarted(group, 1))
    with pytest.raises(NoReportError, match=r"instead: 4 others, .*12.*13.*14.*15, times=1\)$"):
        controller.wait_for(ActionGroupCompleted, group=8, timeout=3)


def test_callbacks_may_use_the_client_and_fail_alone(caplog: pytest.LogCaptureFixture) -> None:
    line = VirtualLine(at_once)
    controller = virtual(line)
    received: list[object] = []
    controller.on_report(lambda _: 1 / 0)
    stop = controller.on_report(
        lambda report: received.append((report, controller.read_battery_voltage()))
    )
    line.say(ActionGroupStopped())
    line.say(ActionGroupCompleted(8, 1))
    assert controller.read_battery_voltage() == 7500
    assert received == [(ActionGroupStopped(), 7500), (ActionGroupCompleted(8, 1), 7500)]
    assert "ZeroDivisionError" in caplog.text
    stop()
    stop()  # what has been ended may be ended again
    line.say(ActionGroupStopped())
    assert list(controller.reports(timeout=0.1))[-1] == ActionGroupStopped()
    assert len(received) == 2


def test_the_thread_that_listens_is_named_after_the_line() -> None:
    line = LiveLine()
    with Controller(line, baud=math.inf, reply_timeout=GENEROUS) as controller:
        controller.read_battery_voltage()
        assert f"busservo on {line.name}" in [thread.name for thread in threading.enumerate()]


def test_eight_threads_share_a_controller() -> None:
    line = LiveLine()
    with (
        Controller(line, baud=math.inf, reply_timeout=GENEROUS) as controller,
        ThreadPoolExecutor(8) as pool,
    ):

        def work(number: int) -> None:
            for turn in range(40):
                servos = [number + 1, 10 * (number + 1)]
                assert controller.read_servo_positions(servos) == tuple((s, 10 * s) for s in servos)
                controller.move_servos([(number, turn)], 100)
                line.say(ActionGroupCompleted(number, turn))

        list(pool.map(work, range(8)))
        said = {(number, turn) for number in range(8) for turn in range(40)}
        await_that(lambda: controller.counters.reports >= 320)
        received = list(controller.reports(timeout=0.1))
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
        line.say(ActionGroupStarted(8, 1))
        await_that(lambda: received == [ActionGroupStarted(8, 1)])
        assert not pending.done()
        line.say(ActionGroupCompleted(8, 1))
        assert pending.result(GENEROUS) == ActionGroupCompleted(8, 1)


def test_a_report_reaches_a_callback_without_any_call() -> None:
    line = LiveLine()
    with Controller(line) as controller:
        received = threading.Event()
        controller.on_report(lambda _: received.set())
        line.say(ActionGroupStopped())
        assert received.wait(GENEROUS)


def test_unplugged_while_a_question_is_under_way() -> None:
    line = LiveLine(lambda _: [])
    with Controller(line, **LIVE) as controller:
        timer = threading.Timer(0.05, line.unplug)
        timer.start()
        with pytest.raises(DisconnectedError, match="plug it in again"):
            controller.read_battery_voltage()
        with pytest.raises(DisconnectedError):
            controller.stop_action_group()
        with pytest.raises(DisconnectedError):
            list(controller.reports())
        timer.join()


def test_reconnecting_is_explicit() -> None:
    line = LiveLine()
    with Controller(line, **LIVE) as controller:
        line.unplug()
        with pytest.raises(DisconnectedError):
            controller.wait_for(ActionGroupStopped, timeout=GENEROUS)
        controller.reconnect()
        assert controller.read_battery_voltage() == 7500
    with pytest.raises(ClosedError):
        controller.reconnect()
    with pytest.raises(TypeError, match="no method reopen"):
        virtual(VirtualLine()).reconnect()


def test_close_ends_the_waits_of_other_threads() -> None:
    line = LiveLine(lambda _: [])
    controller = Controller(line, **LIVE)
    with ThreadPoolExecutor(3) as pool:
        asking = pool.submit(controller.read_battery_voltage)
        listening = pool.submit(lambda: list(controller.reports()))
        pending = pool.submit(controller.wait_for, ActionGroupStopped, timeout=GENEROUS)
        while not line.received:
            threading.Event().wait(0.005)
        controller.close()
        with pytest.raises(ClosedError):
            asking.result(GENEROUS)
        assert listening.result(GENEROUS) == []
        with pytest.raises(ClosedError):
            pending.result(GENEROUS)


def test_an_error_of_the_system_from_a_transport_is_one_of_ours() -> None:
    line = VirtualLine(at_once)
    controller = virtual(line)
    line.error = BrokenPipeError("nobody there")
    with pytest.raises(DisconnectedError, match="nobody there"):
        controller.stop_action_group()
    controller.close()


def test_errors_are_of_one_family() -> None:
    error = TransportError("COM7", "it is in use", "close the other program")
    assert isinstance(error, OSError)
    assert str(error) == "COM7: it is in use; close the other program"
    assert str(error.again()) == str(error)


def test_every_frame_is_logged_and_traced(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    line = VirtualLine(at_once)
    trace = tmp_path / "line.log"
    caplog.set_level(logging.DEBUG, "busservo")
    with virtual(line, trace=trace) as controller:
        line.say(b"\x55\x00" + ActionGroupStopped().encode())
        controller.read_battery_voltage()
    assert "virtual line > BatteryVoltageRead() | 55 55 02 0F" in caplog.text
    assert "virtual line < BatteryVoltage(voltage_mv=7500) | 55 55 04 0F 4C 1D" in caplog.text
    assert "virtual line < bad header | 55 00" in caplog.text
    shown = subprocess.run(
        [sys.executable, "-m", "busservo", "decode", str(trace)],
        check=True,
        capture_output=True,
        text=True,
    )
    assert "BatteryVoltageRead" in shown.stdout
    assert "voltage_mv=7500 mV" in shown.stdout
    assert "3 messages, 2 bytes of noise" in shown.stderr


def test_a_long_trace_is_read_back(tmp_path: Path) -> None:
    for pad in range(3):
        trace = tmp_path / f"{pad}.log"
        with virtual(VirtualLine(at_once), trace=trace, baud=math.inf) as controller:
            for _ in range(600):
                controller.read_battery_voltage()
        # Wherever the first 64 KiB end: in a comment, or between the two digits of a byte.
        trace.write_bytes(b"#" * pad + b"\n" + trace.read_bytes().replace(b"#", b"#" * 3))
        shown = subprocess.run(
            [sys.executable, "-m", "busservo", "decode", str(trace)],
            check=True,
            capture_output=True,
            text=True,
        )
        assert "1200 messages, 0 bytes of noise" in shown.stderr


def test_nothing_is_logged_by_default(caplog: pytest.LogCaptureFixture) -> None:
    virtual(VirtualLine(at_once)).read_battery_voltage()
    assert caplog.records == []


def test_the_codec_imports_no_client() -> None:
    def loaded(code: str) -> str:
        shown = f"{code}; import sys; print(sorted({HEAVY} & set(sys.modules)))"
        done = subprocess.run(
            [sys.executable, "-S", "-c", shown],
            env={**os.environ, "PYTHONPATH": str(Path(busservo.__file__).parent.parent)},
            capture_output=True,
            text=True,
            check=True,
        )
        return done.stdout

    assert loaded("import busservo") == loaded("pass")
    assert "asyncio" not in loaded("import busservo; busservo.Controller")


def test_a_question_of_one_request_names_what_is_missing_from_its_reply() -> None:
    """As for a protocol whose replies have room for all that can be requested at once."""
    line = VirtualLine(lambda _: [(0.0, ServoPositions([(2, 20)]))])
    with pytest.raises(IncompleteReplyError) as caught:
        virtual(line)._ask(ServoPositionsRead([1, 2, 3]), ServoPositions)
    assert caught.value.missing == (1, 3)
    assert caught.value.arrived == ((2, 20),)
    with pytest.raises(TypeError, match="is answered by BatteryVoltage"):
        virtual(VirtualLine(at_once))._ask(BatteryVoltageRead(), ServoPositions)


def test_the_repr_of_a_client_shows_its_state() -> None:
    line = VirtualLine(at_once)
    controller = virtual(line)
    assert repr(controller) == "<Controller on virtual line, open>"
    line.error = BrokenPipeError("nobody there")
    with pytest.raises(DisconnectedError):
        controller.stop_action_group()
    assert repr(controller) == "<Controller on virtual line, failed>"
    controller.close()
    assert repr(controller) == "<Controller on virtual line, closed>"


def test_the_repr_of_a_line_shows_its_statistics() -> None:
    controller = virtual(VirtualLine(at_once))
    sent = controller.send(ActionGroupStop())
    assert repr(sent) == "Sent(ActionGroupStop(), delay=0.0000, duration=0.0042)"
    controller.read_battery_voltage()
    assert repr(controller.counters) == (
        "LineCounters(echoes=0, impossible=1, lost_reports=0, noise=0, replaced=0, replies=1, "
        "reports=0, retries=0, sent=2, timeouts=0, unsolicited=0)"
    )
