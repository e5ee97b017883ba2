"""The session alone: no line, no clock, no thread; every promise of its docstring, one by one."""

import math
from collections.abc import Callable

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
from framewire.client.request import Request
from framewire.client.session import Session

from tests.in_turn import in_turn
from tests.lines.questions import REPLY_TIMEOUT, TRIP, ask, expires, say, session

QUESTION, REPORT = BatteryVoltageRead().encode(), ActionGroupCompleted(8, 1).encode()
HALF_A_REPLY = BatteryVoltage(7500).encode()[:-1]


@in_turn("other", lambda: [None, ActionGroupCompleted(8, 1), ServoPositions([(1, 264)])])
def test_a_reply_ends_its_request_and_nothing_else_does(other: Message | None) -> None:
    line = session()
    request = ask(line)
    if other is not None:
        say(line, 0.02, other)
    assert not request.done
    say(line, 0.03, 7500)
    assert request.done
    assert request.reply == BatteryVoltage(7500)
    assert line.idle


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
    request = ask(line, 0.0, ServoPositionsRead([1, 2]))
    say(line, 0.02, ServoPositions(positions))
    assert request.done is accepted
    assert line.counters.unsolicited == (not accepted)


def test_a_missing_reply_is_an_error_that_names_the_request() -> None:
    line = session()
    request = ask(line)
    deadline = expires(line)
    assert deadline == pytest.approx(TRIP + REPLY_TIMEOUT)
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
    line.tick(5 + TRIP + REPLY_TIMEOUT)
    assert isinstance(request.error, NoReplyError)
    assert request.error.waited == pytest.approx(1 + TRIP + REPLY_TIMEOUT)
    # And so does the time that its late reply has: nothing of its kind is sent meanwhile.
    line.submit(BatteryVoltageRead())
    assert line.outgoing(5.5) == []


def test_a_question_that_the_port_never_takes_ends_all_the_same() -> None:
    line = session()
    request = line.submit(BatteryVoltageRead())
    line.outgoing(0.0)
    assert expires(line) < 2
    line.tick(expires(line))
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
    first = ask(line)
    now = end(line, first)
    assert first.done or end is cancelled
    second = line.submit(BatteryVoltageRead())
    assert line.outgoing(now) == []
    say(line, now + 0.01, 1)
    assert not second.done
    # A line that was opened again settles first.
    now += 0.2 if end is reconnected else 0.01
    assert line.outgoing(now) == [QUESTION]
    line.written(second, now)
    say(line, now + 0.02, 2)
    assert second.reply == BatteryVoltage(2)
    assert line.counters.unsolicited == 1


def test_the_next_question_of_a_kind_waits_no_longer_than_twice_the_reply_time() -> None:
    line = session()
    ask(line)
    deadline = expires(line)
    line.tick(deadline)
    line.submit(BatteryVoltageRead())
    at = line.send_at(deadline)
    assert at is not None
    assert at == pytest.approx(4 / 960 + 2 * (REPLY_TIMEOUT + 6 / 960))
    assert line.outgoing(at - 0.001) == []
    assert line.outgoing(at) == [QUESTION]


def test_a_question_of_another_kind_does_not_wait_for_a_late_reply() -> None:
    line = session()
    ask(line)
    line.tick(0.3)
    request = ask(line, 0.3, ServoPositionsRead([1]))
    say(line, 0.32, 1, ServoPositions([(1, 5)]))
    assert request.reply == ServoPositions([(1, 5)])


def test_a_request_cancelled_before_it_was_sent_is_never_sent() -> None:
    line = session()
    ask(line)
    line.cancel(line.submit(BatteryVoltageRead()))
    say(line, 0.02, 1)
    assert line.outgoing(0.03) == []
    assert line.idle


def test_a_retry_takes_the_late_reply_of_the_attempt_before() -> None:
    line = session()
    request = ask(line, retries=1)
    line.tick(0.3)
    assert not request.done
    assert line.outgoing(0.3) == [QUESTION]
    say(line, 0.301, 1)
    assert request.reply == BatteryVoltage(1)
    # The other attempt's reply may be yet to come, and is nobody's.
    line.submit(BatteryVoltageRead())
    assert line.outgoing(0.32) == []
    say(line, 0.33, 2)
    assert line.outgoing(0.33) != []


def test_a_command_does_not_wait_for_a_reply() -> None:
    line = session()
    ask(line)
    stop = line.submit(ActionGroupStop())
    assert line.outgoing(0.01) == [ActionGroupStop().encode()]
    assert stop.done
    assert stop.sent is not None


def test_questions_are_sent_one_at_a_time_in_order() -> None:
    line = session(baud=math.inf)
    questions = [ServoPositionsRead([servo]) for servo in (1, 2, 3)]
    for each in questions:
        line.submit(each)
    for each in questions:
        assert line.outgoing(0.0) == [each.encode()]
        assert line.outgoing(0.0) == []
        say(line, 0.0, ServoPositions([(each.servo_ids[0], 5)]))


def test_frames_are_handed_over_no_faster_than_the_line_takes_them() -> None:
    line = session()
    requests = [line.submit(ServoMove(800, [(n, 500) for n in range(6)])) for _ in range(40)]
    now = 0.0
    while not line.idle:
        assert len(line.outgoing(now)) <= 1
        at = line.send_at(now)
        now = now if at is None else max(at, now)
    sent = [each.sent for each in requests if each.sent is not None]
    assert max(each.delay for each in sent) <= 0.004 + 1e-9
    assert [each.duration for each in sent] == pytest.approx([25 / 960] * 40)
    # And the line is never idle meanwhile.
    assert line.wire_time.free_at == pytest.approx(40 * 25 / 960)


def test_the_latest_takes_the_place_of_what_it_covers() -> None:
    line = session()
    line.submit(ActionGroupStop())
    line.outgoing(0.0)
    for position in range(50):
        line.submit(ServoMove(20, [(1, position), (2, position)]), latest=True)
        line.submit(ServoMove(20, [(3, position)]), latest=True)
    kept = [line.outgoing(now)[0] for now in (1.0, 2.0)]
    assert kept == [ServoMove(20, [(1, 49), (2, 49)]).encode(), ServoMove(20, [(3, 49)]).encode()]
    assert line.idle
    assert line.counters.replaced == 98
    for servo_ids in ([1, 2], [3], [2, 1], [4, 2, 1]):
        line.submit(ServoUnload(servo_ids), latest=True)
    kept = [line.outgoing(now)[0] for now in (3.0, 4.0)]
    assert kept == [ServoUnload([3]).encode(), ServoUnload([4, 2, 1]).encode()]
    assert line.idle


def test_bytes_of_half_a_frame_are_told_where_no_reply_came() -> None:
    line = session()
    request = ask(line)
    say(line, 0.02, HALF_A_REPLY)
    while not request.done:
        line.tick(expires(line))
    assert isinstance(request.error, NoReplyError)
    assert request.error.noise == 5


def test_half_a_frame_does_not_grow_together_with_the_next_reply() -> None:
    line = session()
    ask(line)
    say(line, 0.02, HALF_A_REPLY)
    line.tick(0.3)
    line.tick(0.6)
    request = ask(line, 0.6)
    say(line, 0.63, 7400)
    line.tick(0.9)
    assert request.reply == BatteryVoltage(7400)


def test_half_a_report_is_not_lost_because_a_request_times_out_meanwhile() -> None:
    line = session()
    request, end = ask(line), expires(line)
    say(line, end - 0.04, REPORT[:4])
    # Something is arriving, so the question has a little longer; but no longer than that.
    line.tick(end)
    assert not request.done
    say(line, end, b"")
    line.tick(end + 0.005)
    say(line, end + 0.009, REPORT[4:6])
    line.tick(end + 0.05)
    assert isinstance(request.error, NoReplyError)
    say(line, end + 0.055, REPORT[6:])
    assert line.reports.take() == ActionGroupCompleted(8, 1)
    assert line.counters.noise == 0


def test_stray_bytes_and_half_a_report_are_told_together_where_no_reply_came() -> None:
    line = session()
    request = ask(line)
    say(line, 0.02, b"\xff\xff\xff")
    end = expires(line)
    say(line, end - 0.04, REPORT[:4])
    say(line, end + 0.009, REPORT[4:6])
    line.tick(end + 0.05)
    assert isinstance(request.error, NoReplyError)
    assert request.error.noise == 3 + 6


def test_a_reply_behind_a_false_header_is_found_before_the_time_is_up() -> None:
    line = session()
    request = ask(line)
    say(line, 0.25, bytes.fromhex("55 55 21 15 0A"), 7500)
    assert not request.done
    line.tick(expires(line))
    assert request.reply == BatteryVoltage(7500)
    assert line.counters.noise == 5


def test_what_cannot_be_asked_or_sent_is_refused() -> None:
    line = session()
    line.submit(ServoPositionsRead(range(84)))
    problem = "85 items are requested at once, and a reply has room for 84"
    with pytest.raises(EncodeError, match=problem):
        line.submit(ServoPositionsRead(range(85)))
    with pytest.raises(TypeError, match="nothing that this end sends"):
        line.submit(BatteryVoltage(7500))


def test_a_lost_line_ends_everything() -> None:
    line = session()
    requests = [ask(line), line.submit(ServoPositionsRead([1]))]
    error = TransportError("port", "gone", "look for it")
    line.fail(error)
    assert [request.error for request in requests] == [error, error]
    assert line.idle


WRONG = [("baud", 0), ("baud", -1), ("baud", math.nan), ("reply_timeout", 0), ("report_limit", 0)]


@in_turn("name, value", lambda: [*WRONG, ("settle", -1), ("settle", math.nan)])
def test_invalid_settings_are_refused(name: str, value: float) -> None:
    with pytest.raises(ValueError, match="must be"):
        session(**{name: value})


def test_the_time_for_a_reply_is_that_of_the_largest_that_can_answer() -> None:
    """Of a reply whose list is as long as the request, it is that one, and else the largest."""
    ids, largest = ("servo_ids", "positions.servo_id"), 2 + 255
    echoed = Exchange("ask", (), reply=ServoPositions, echoed=(ids,))
    other = Exchange("ask", (), reply=ServoPositions, echoed=(("servo_ids", "other"),))
    for exchange, asked, size in (
        (echoed, 2, len(ServoPositions([(1, 500), (2, 500)]).encode())),
        (Exchange("ask", (), reply=ServoPositions), 2, largest),
        (other, 2, largest),
        (Exchange("tell", ()), 2, 0),
        # More than fits in one reply: there is no such frame, and the largest stands for it.
        (echoed, 200, largest),
    ):
        assert exchange.reply_size(ServoPositionsRead(range(asked)), LIBRARY.codec) == size
