"""Lines that return what is sent: expected, compared and dropped; or noticed, and reported."""

import logging
from collections.abc import Callable, Iterable
from typing import Any

import busservo
import pytest
from busservo import ActionGroupRun, ActionGroupStop, BatteryVoltageRead, EchoError, Message
from busservo._exchanges import EXCHANGES
from framewire.client.local_echo import LocalEcho
from framewire.client.request import Request

from tests.in_turn import in_turn
from tests.lines.both_clients import both_live
from tests.lines.live_line import LiveLine, answered
from tests.lines.questions import session
from tests.lines.receiving import unanswered
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.timeouts import LIVE

Incoming = Iterable[tuple[float, bytes | Message]]

STARTED = busservo.ActionGroupStarted(8, 1)


def wire(message: Message) -> float:
    return len(message.encode()) / 960


def replies(message: Message) -> Incoming:
    """Yield the replies of a board with a voltage only."""
    if isinstance(message, BatteryVoltageRead):
        yield wire(message) + 0.02, busservo.BatteryVoltage(7500)


def echoing(message: Message) -> Incoming:
    """Yield the echo of a half-duplex adapter, and the replies."""
    yield wire(message), message.encode()
    yield from replies(message)


def in_pieces(message: Message) -> Incoming:
    """Yield the echo byte by byte, with a report in front of it."""
    yield 0.0, STARTED
    for number, byte in enumerate(message.encode()):
        yield number / 960, bytes([byte])
    yield from replies(message)


def changed(message: Message) -> Incoming:
    frame = bytearray(message.encode())
    frame[-1] ^= 1
    yield wire(message), bytes(frame)


def virtual(answer: Callable[[Message], Any], *, local_echo: bool = True) -> Any:
    return client_on(VirtualLine(answer), busservo.Controller, local_echo=local_echo)


@in_turn("answer", lambda: [echoing, in_pieces])
def test_what_was_sent_comes_back_and_is_dropped(answer: Callable[[Message], Incoming]) -> None:
    with virtual(answer) as controller:
        assert controller.read_battery_voltage() == 7500
        controller.stop_action_group()
        controller.run_action_group(8, times=1)
        received = [STARTED] * 3 if answer is in_pieces else []
        assert list(controller.reports(timeout=1)) == received
        assert controller.counters.echoes == 3
        assert controller.counters.noise == 0


def test_an_echo_that_a_later_one_overtakes_is_missing() -> None:
    line = session(local_echo=True)
    first, second = line.submit(ActionGroupStop()), line.submit(ActionGroupRun(8, 1))
    assert len(line.outgoing(0.0)) == 1
    assert len(line.outgoing(0.01)) == 1
    line.receive(second.message.encode(), 0.02)
    assert isinstance(first.error, EchoError)
    assert (first.sent, second.error) == (None, None)
    assert second.sent is not None
    assert line.idle


@in_turn("answer", lambda: [unanswered, replies, changed])
def test_a_missing_echo_is_an_error(answer: Callable[[Message], Incoming]) -> None:
    with virtual(answer) as controller:
        with pytest.raises(EchoError, match="leave out local_echo") as caught:
            controller.move_servos([(1, 500)], time_ms=0)
        assert isinstance(caught.value, busservo.TransportError)
        with pytest.raises(EchoError):
            controller.read_battery_voltage()


def test_a_motion_that_nobody_waits_for_says_so_in_the_log(caplog: Any) -> None:
    with virtual(unanswered) as controller:
        controller.send_latest(busservo.ServoMove(0, [(1, 500)]))
        assert list(controller.reports(timeout=1)) == []
    assert "has not come back" in caplog.text


def live(answer: Callable[[Message], list[Message]] = answered) -> LiveLine:
    return LiveLine(lambda message: [message, *answer(message)])


@both_live(live, local_echo=True, **LIVE)
async def test_the_same_in_real_time(controller: Any) -> None:
    await controller.stop_action_group()
    assert await controller.read_battery_voltage() == 7500
    assert [report async for report in controller.reports(timeout=0.05)] == []


# ---------------------------------------------------------------- unless it is said
def test_an_undeclared_echo_is_recognized_by_what_no_board_can_send(caplog: Any) -> None:
    with caplog.at_level(logging.WARNING), virtual(echoing, local_echo=False) as controller:
        for _ in range(3):
            assert controller.read_battery_voltage() == 7500
        assert controller.counters.echoes == 3
    (said,) = [each for each in caplog.records if "local_echo=True" in each.getMessage()]
    assert "gives back what is sent" in said.getMessage()


# ---------------------------------------------------------------- the filter alone
def request(message: Message) -> Request:
    return Request(message, EXCHANGES[type(message)])


def test_what_is_forgotten_is_no_longer_expected_and_everything_else_is() -> None:
    echo = LocalEcho()
    first, second = request(ActionGroupStop()), request(BatteryVoltageRead())
    for each in (first, second):
        echo.sent(each, each.message.encode(), 1.0)
    echo.forget(first)
    assert not echo.expects(first)
    assert echo.expects(second)
    frames = ActionGroupStop().encode() + BatteryVoltageRead().encode()
    assert [*echo.take_out(frames)] == [(ActionGroupStop().encode(), second, []), (b"", None, [])]
