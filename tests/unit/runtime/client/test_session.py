"""The session alone: no line, no clock, no thread; every promise of its docstring, one by one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupStop,
    BatteryVoltage,
    BatteryVoltageRead,
    EncodeError,
    Message,
    NoReplyError,
    ServoMove,
    ServoPositions,
    ServoPositionsRead,
    ServoUnload,
    TransportError,
)
from busservo._library import LIBRARY
from framewire.client.exchange import Exchange
from framewire.client.session import Session

from tests.in_turn import in_turn

if TYPE_CHECKING:
    from collections.abc import Callable

    from framewire.client.request import Request


def session(**changed: float) -> Session:
    return Session(LIBRARY, baud=changed.get("baud", 9600), reply_timeout=0.25, report_limit=16)


def requested(at: Session, message: Message, now: float = 0.0, retries: int = 0) -> Request:
    request = at.submit(message, retries=retries)
    assert at.outgoing(now) == [message.encode()]
    at.written(request, now)
    return request


def test_a_reply_ends_its_request() -> None:
    line = session()
    request = requested(line, BatteryVoltageRead())
    line.receive(BatteryVoltage(7500).encode(), 0.02)
    assert request.done
    assert request.reply == BatteryVoltage(7500)
    assert line.idle


@in_turn(
    "other",
    lambda: [
        ActionGroupCompleted(8, 1),
        ServoPositions([(1, 264)]),
    ],
)
def test_nothing_else_becomes_a_battery_voltage(other: Message) -> None:
    line = session()
    request = requested(line, BatteryVoltageRead())
    line.receive(other.encode(), 0.02)
    assert not request.done
    line.receive(BatteryVoltage(7500).encode(), 0.03)
    assert request.reply == BatteryVoltage(7500)


@in_turn(
    "positions, accepted",
    lambda: [
        ([(1, 5), (2, 6)], True),
        ([(2, 6), (1, 5)], True),
        ([(2, 6)], True),
        ([], True),
        ([(3, 6)], False),
        ([(1, 5), (3, 6)], False),
        ([(1, 5), (1, 6)], False),
        ([(1, 5), (2, 6), (2, 6)], False),
    ],
)
def test_a_reply_about_anything_not_requested_is_unsolicited(
    positions: list[tuple[int, int]], accepted: bool
) -> None:
    line = session()
    request = requested(line, ServoPositionsRead([1, 2]))
    line.receive(ServoPositions(positions).encode(), 0.02)
    assert request.done is accepted
    assert line.counters.unsolicited == (not accepted)


def test_a_missing_reply_is_an_error_that_names_the_request() -> None:
    line = session()
    request = requested(line, BatteryVoltageRead())
    deadline = line.tick_at
    assert deadline is not None
    assert deadline == pytest.approx((4 + 6) / 960 + 0.25)
    line.tick(deadline - 1e-9)
    assert not request.done
    line.tick(deadline)
    assert isinstance(request.error, NoReplyError)
    assert isinstance(request.error, TimeoutError)
    assert request.error.request == BatteryVoltageRead()
    assert "no BatteryVoltage came within" in str(request.error)


def test_the_time_for_an_answer_begins_when_the_port_has_the_question() -> None:
    line = session()
    request = line.submit(BatteryVoltageRead())
    line.outgoing(4.0)
    line.tick(5.0)
    assert line.unwritten is request
    line.written(request, 5.0)
    assert line.unwritten is None
    assert line.wire_time.free_at == pytest.approx(5 + 4 / 960)
    line.tick(5.25)
    assert not request.done
    line.written(request, 9.0)  # said once, it holds
    line.tick(5 + (4 + 6) / 960 + 0.25)
    assert isinstance(request.error, NoReplyError)
    assert request.error.waited == pytest.approx(1 + 10 / 960 + 0.25)
    # And so does the time that its late reply has: nothing of its kind is sent meanwhile.
    line.submit(BatteryVoltageRead())
    assert line.outgoing(5.5) == []


def test_a_question_that_the_port_never_takes_ends_all_the_same() -> None:
    line = session()
    request = line.submit(BatteryVoltageRead())
    line.outgoing(0.0)
    assert line.tick_at is not None
    assert line.tick_at < 2
    line.tick(line.tick_at)
    assert isinstance(request.error, NoReplyError)


def timed_out(line: Session, _: Request) -> float:
    line.tick(0.3)
    return 0.3


def paused(line: Session, _: Request) -> float:
    """For two seconds nothing ran here, the other end of a socket on this machine included."""
    line.tick(2.0)
    return 2.0


def cancelled(line: Session, request: Request) -> float:
    line.cancel(request)
    return 0.01


def reconnected(line: Session, _: Request) -> float:
    line.fail(TransportError("port", "gone", "look for it"))
    line.restart(0.0)
    return 0.1


@in_turn("end", lambda: [timed_out, paused, cancelled, reconnected])
def test_the_next_question_of_a_kind_waits_for_the_late_reply(
    end: Callable[[Session, Request], float],
) -> None:
    line = session()
    first = requested(line, BatteryVoltageRead())
    now = end(line, first)
    assert first.done or end is cancelled
    second = line.submit(BatteryVoltageRead())
    assert line.outgoing(now) == []
    line.receive(BatteryVoltage(1).encode(), now + 0.01)
    assert not second.done
    # A line that was opened again settles first.
    now += 0.2 if end is reconnected else 0.01
    assert line.outgoing(now) == [BatteryVoltageRead().encode()]
    line.written(second, now)
    line.receive(BatteryVoltage(2).encode(), now + 0.02)
    assert second.reply == BatteryVoltage(2)
    assert line.counters.unsolicited == 1


def test_the_next_question_of_a_kind_waits_no_longer_than_twice_the_reply_time() -> None:
    line = session()
    requested(line, BatteryVoltageRead())
    deadline = line.tick_at
    assert deadline is not None
    line.tick(deadline)
    line.submit(BatteryVoltageRead())
    at = line.send_at(deadline)
    assert at is not None
    assert at == pytest.approx(4 / 960 + 2 * (0.25 + 6 / 960))
    assert line.outgoing(at - 0.001) == []
    assert line.outgoing(at) == [BatteryVoltageRead().encode()]


def test_a_question_of_another_kind_does_not_wait_for_a_late_reply() -> None:
    line = session()
    requested(line, BatteryVoltageRead())
    line.tick(0.3)
    request = requested(line, ServoPositionsRead([1]), 0.3)
    line.receive(BatteryVoltage(1).encode() + ServoPositions([(1, 5)]).encode(), 0.32)
    assert request.reply == ServoPositions([(1, 5)])


def test_a_request_cancelled_before_it_was_sent_is_never_sent() -> None:
    line = session()
    requested(line, BatteryVoltageRead())
    pending = line.submit(BatteryVoltageRead())
    line.cancel(pending)
    line.receive(BatteryVoltage(1).encode(), 0.02)
    assert line.outgoing(0.03) == []
    assert line.idle


def test_a_retry_takes_the_late_reply_of_the_attempt_before() -> None:
    line = session()
    request = requested(line, BatteryVoltageRead(), retries=1)
    line.tick(0.3)
    assert not request.done
    assert line.outgoing(0.3) == [BatteryVoltageRead().encode()]
    line.receive(BatteryVoltage(1).encode(), 0.31)
    assert request.reply == BatteryVoltage(1)
    # The other attempt's reply may be yet to come, and is nobody's.
    line.submit(BatteryVoltageRead())
    assert line.outgoing(0.32) == []
    line.receive(BatteryVoltage(2).encode(), 0.33)
    assert line.outgoing(0.33) != []


def test_a_command_does_not_wait_for_a_reply() -> None:
    line = session()
    requested(line, BatteryVoltageRead())
    stop = line.submit(ActionGroupStop())
    assert line.outgoing(0.01) == [ActionGroupStop().encode()]
    assert stop.done
    assert stop.sent is not None


def test_questions_are_sent_one_at_a_time_in_order() -> None:
    line = session(baud=math.inf)
    for servo in (1, 2, 3):
        line.submit(ServoPositionsRead([servo]))
    sent = []
    for servo in (1, 2, 3):
        sent += line.outgoing(0.0)
        assert line.outgoing(0.0) == []
        line.receive(ServoPositions([(servo, 5)]).encode(), 0.0)
    assert sent == [ServoPositionsRead([servo]).encode() for servo in (1, 2, 3)]


def test_frames_are_handed_over_no_faster_than_the_line_takes_them() -> None:
    line = session()
    move = ServoMove(800, [(servo, 500) for servo in range(6)])
    requests = [line.submit(move) for _ in range(40)]
    now = 0.0
    while not line.idle:
        sent = line.outgoing(now)
        for request in [each for each in requests if each.done and each.sent]:
            assert request.sent is not None
            assert request.sent.delay <= 0.004 + 1e-9
            assert request.sent.duration == pytest.approx(25 / 960)
        assert len(sent) <= 1
        at = line.send_at(now)
        now = now if at is None else max(at, now)
    # And the line is never idle meanwhile.
    assert line.wire_time.free_at == pytest.approx(40 * 25 / 960)


def test_the_latest_takes_the_place_of_what_it_covers() -> None:
    line = session()
    line.submit(ActionGroupStop())
    line.outgoing(0.0)
    for position in range(50):
        line.submit(ServoMove(20, [(1, position), (2, position)]), latest=True)
        line.submit(ServoMove(20, [(3, position)]), latest=True)
    kept = []
    now = 0.0
    while not line.idle:
        kept += line.outgoing(now)
        now += 0.01
    assert kept == [ServoMove(20, [(1, 49), (2, 49)]).encode(), ServoMove(20, [(3, 49)]).encode()]
    assert line.counters.replaced == 98


def test_the_latest_takes_the_place_of_what_names_the_same_servos_or_fewer() -> None:
    line = session()
    line.submit(ActionGroupStop())
    line.outgoing(0.0)
    for servo_ids in ([1, 2], [3], [2, 1], [4, 2, 1]):
        line.submit(ServoUnload(servo_ids), latest=True)
    kept = [line.outgoing(now)[0] for now in (1.0, 2.0)]
    assert kept == [ServoUnload([3]).encode(), ServoUnload([4, 2, 1]).encode()]
    assert line.idle


def test_bytes_of_half_a_frame_are_told_where_no_reply_came() -> None:
    line = session()
    request = requested(line, BatteryVoltageRead())
    line.receive(BatteryVoltage(7500).encode()[:-1], 0.02)
    while not request.done:
        assert line.tick_at is not None
        line.tick(line.tick_at)
    assert isinstance(request.error, NoReplyError)
    assert request.error.noise == 5


def test_half_a_frame_does_not_grow_together_with_the_next_reply() -> None:
    line = session()
    requested(line, BatteryVoltageRead())
    line.receive(BatteryVoltage(7500).encode()[:-1], 0.02)
    line.tick(0.3)
    line.tick(0.6)
    request = requested(line, BatteryVoltageRead(), 0.6)
    line.receive(BatteryVoltage(7400).encode(), 0.63)
    line.tick(0.9)
    assert request.reply == BatteryVoltage(7400)


def test_half_a_report_is_not_lost_because_a_request_times_out_meanwhile() -> None:
    line = session()
    request = requested(line, BatteryVoltageRead())
    report = ActionGroupCompleted(8, 1)
    assert line.tick_at is not None
    expires = line.tick_at
    line.receive(report.encode()[:4], expires - 0.04)
    # Something is arriving, so the question has a little longer; but no longer than that.
    line.tick(expires)
    assert not request.done
    line.receive(b"", expires)
    line.tick(expires + 0.005)
    line.receive(report.encode()[4:6], expires + 0.009)
    line.tick(expires + 0.05)
    assert isinstance(request.error, NoReplyError)
    line.receive(report.encode()[6:], expires + 0.055)
    assert line.reports.take() == report
    assert line.counters.noise == 0


def test_stray_bytes_and_half_a_report_are_told_together_where_no_reply_came() -> None:
    line = session()
    request = requested(line, BatteryVoltageRead())
    line.receive(b"\xff\xff\xff", 0.02)
    assert line.tick_at is not None
    expires = line.tick_at
    report = ActionGroupCompleted(8, 1).encode()
    line.receive(report[:4], expires - 0.04)
    line.receive(report[4:6], expires + 0.009)
    line.tick(expires + 0.05)
    assert isinstance(request.error, NoReplyError)
    assert request.error.noise == 3 + 6


def test_a_reply_behind_a_false_header_is_found_before_the_time_is_up() -> None:
    line = session()
    request = requested(line, BatteryVoltageRead())
    line.receive(bytes.fromhex("55 55 21 15 0A") + BatteryVoltage(7500).encode(), 0.25)
    assert not request.done
    assert line.tick_at is not None
    line.tick(line.tick_at)
    assert request.reply == BatteryVoltage(7500)
    assert line.counters.noise == 5


def test_more_than_a_reply_has_room_for_is_refused() -> None:
    line = session()
    line.submit(ServoPositionsRead(range(84)))
    with pytest.raises(
        EncodeError, match="85 items are requested at once, and a reply has room for 84"
    ):
        line.submit(ServoPositionsRead(range(85)))


def test_a_message_of_the_controller_cannot_be_sent() -> None:
    with pytest.raises(TypeError, match="nothing that this end sends"):
        session().submit(BatteryVoltage(7500))


def test_a_lost_line_ends_everything() -> None:
    line = session()
    requests = [requested(line, BatteryVoltageRead()), line.submit(ServoPositionsRead([1]))]
    error = TransportError("port", "gone", "look for it")
    line.fail(error)
    assert [request.error for request in requests] == [error, error]
    assert line.idle


@in_turn(
    "wrong",
    lambda: [
        {"baud": 0},
        {"baud": -1},
        {"baud": math.nan},
        {"reply_timeout": 0},
        {"report_limit": 0},
    ],
)
def test_invalid_settings_are_refused(wrong: dict[str, float]) -> None:
    good: dict[str, float] = {"baud": 9600, "reply_timeout": 0.25, "report_limit": 16}
    with pytest.raises(ValueError, match="must be"):
        Session(LIBRARY, **(good | wrong))  # type: ignore[arg-type]


# -------------------------------------------------------------------- how long a reply may be


def test_the_time_for_a_reply_is_that_of_the_largest_that_can_answer() -> None:
    """Of a reply whose list is as long as the request, it is that one, and else the largest."""
    echoed = (("servo_ids", "positions.servo_id"),)
    question = ServoPositionsRead([1, 2])
    largest = 2 + 255
    for exchange, size in (
        (Exchange("ask", (), reply=ServoPositions, echoed=echoed), len(two_positions())),
        (Exchange("ask", (), reply=ServoPositions), largest),
        (Exchange("ask", (), reply=ServoPositions, echoed=(("servo_ids", "other"),)), largest),
        (Exchange("tell", ()), 0),
    ):
        assert exchange.reply_size(question) == size
    # More than fits in one reply: there is no such frame, and the largest stands for it.
    assert (
        Exchange("ask", (), reply=ServoPositions, echoed=echoed).reply_size(
            ServoPositionsRead(range(200))
        )
        == largest
    )


def two_positions() -> bytes:
    return ServoPositions([(1, 500), (2, 500)]).encode()
