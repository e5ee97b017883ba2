"""The session alone: no line, no clock, no thread; every promise of its docstring, one by one."""

import math
from collections.abc import Callable

import busservo
import pytest
from busservo import BatteryVoltageRead, NoReplyError, ServoMove, ServoPositions, ServoPositionsRead
from framewire.client.exchange import Exchange
from framewire.client.request import Request
from framewire.client.session import Session
from framewire.codec.gap import GAP

from tests.in_turn import in_turn
from tests.lines import questions
from tests.lines.questions import REPLY_TIMEOUT, TRIP, say, session
from tests.lines.stories import (
    QUESTION,
    ask,
    cancel,
    counted,
    failed,
    hear,
    idle,
    pending,
    replied,
    reported,
    send,
    tick,
    told,
    want,
)

REPORT = busservo.ActionGroupCompleted(8, 1)
FIRST, REST = REPORT.encode()[:4], REPORT.encode()[4:]
HALF_A_REPLY = busservo.BatteryVoltage(7500).encode()[:-1]
STOP, FALSE_HEADER = busservo.ActionGroupStop(), bytes.fromhex("55 55 21 15 0A")
END = TRIP + REPLY_TIMEOUT
ONE = ServoPositions([(1, 5)])


test_a_question_and_its_reply = told(
    {
        "a reply ends its request": [ask(), hear(0.03, 7500), replied(7500), idle],
        "no report does": [ask(), hear(0.02, REPORT), pending, hear(0.03, 7500), replied(7500)],
        "no other reply does": [ask(), hear(0.02, ONE), pending, hear(0.03, 7500), replied(7500)],
        "a missing reply is an error that names the request": [
            *[ask(), tick(END - 1e-9), pending, tick(END)],
            failed(NoReplyError, "no BatteryVoltage came within", request=QUESTION),
            failed(TimeoutError),
        ],
        "a question of another kind does not wait for a late reply": [
            *[ask(), tick(0.3), ask(0.3, ServoPositionsRead([1]))],
            *[hear(0.32, 1, ONE), replied(ONE)],
        ],
        "a request cancelled before it was sent is never sent": [
            *[ask(), want(), cancel(), hear(0.02, 1), send(0.03), idle]
        ],
        "a retry takes the late reply of the attempt before": [
            *[ask(retries=1), tick(0.3), pending, send(0.3, QUESTION), hear(0.301, 1), replied(1)],
            # The other attempt's reply may be yet to come, and is nobody's.
            *[want(), send(0.32), hear(0.33, 2), send(0.33, QUESTION)],
        ],
        "a command does not wait for a reply": [ask(), want(STOP), send(0.01, STOP)],
        "bytes of half a frame are told where no reply came": [
            *[ask(), hear(0.02, HALF_A_REPLY), tick(0.1), tick(END), failed(NoReplyError, noise=5)]
        ],
        "half a frame does not grow together with the next reply": [
            *[ask(), hear(0.02, HALF_A_REPLY), tick(0.3), tick(0.6)],
            *[ask(0.6), hear(0.63, 7400), tick(0.9), replied(7400)],
        ],
        "half a report is not lost because a request times out meanwhile": [
            # Something is arriving, so the question has a little longer; but no longer than that.
            *[
                ask(),
                hear(END - 0.04, FIRST),
                tick(END),
                pending,
                hear(END, b""),
                tick(END + 0.005),
            ],
            *[hear(END + 0.009, REST[:2]), tick(END + 0.05), failed(NoReplyError)],
            *[hear(END + 0.055, REST[2:]), reported(REPORT), counted(noise=0)],
        ],
        "stray bytes and half a report are told together where no reply came": [
            *[ask(), hear(0.02, b"\xff\xff\xff"), hear(END - 0.04, FIRST)],
            *[hear(END + 0.009, REST[:2]), tick(END + 0.05), failed(NoReplyError, noise=3 + 6)],
        ],
        "a reply behind a false header is found before the time is up": [
            *[ask(), hear(0.25, FALSE_HEADER, 7500), pending, tick(0.3)],
            *[replied(7500), counted(noise=5)],
        ],
    }
)


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
    request = questions.ask(line, 0.0, ServoPositionsRead([1, 2]))
    say(line, 0.02, ServoPositions(positions))
    assert request.done is accepted
    assert line.counters.unsolicited == (not accepted)


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
    line.tick(5 + END)
    assert isinstance(request.error, NoReplyError)
    assert request.error.waited == pytest.approx(1 + END)
    # And so does the time that its late reply has: nothing of its kind is sent meanwhile.
    line.submit(BatteryVoltageRead())
    assert line.outgoing(5.5) == []


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
    line.fail(busservo.TransportError("port", "gone", "look for it"))
    line.restart(0.0)
    return 0.1


@in_turn("end", lambda: [timed_out, paused, cancelled, reconnected])
def test_the_next_question_of_a_kind_waits_for_the_late_reply(
    end: Callable[[Session, Request], float],
) -> None:
    line = session()
    first = questions.ask(line)
    now = end(line, first)
    assert first.done or end is cancelled
    second = line.submit(BatteryVoltageRead())
    assert line.outgoing(now) == []
    say(line, now + 0.01, 1)
    assert not second.done
    # A line that was opened again settles first.
    now += 0.2 if end is reconnected else 0.01
    assert line.outgoing(now) == [QUESTION.encode()]
    line.written(second, now)
    say(line, now + 0.02, 2)
    assert second.reply == busservo.BatteryVoltage(2)
    assert line.counters.unsolicited == 1


def test_a_reader_may_sleep_until_what_has_begun_can_be_complete_and_no_longer() -> None:
    line = session()
    assert line.resting_until(1.0) == 1.0
    say(line, 1.0, FIRST)
    assert line.resting_until(1.0) == pytest.approx(1.0 + line.wire_time.least(len(REST) - 1))
    questions.ask(line, 1.0, ServoPositionsRead(range(84)))
    assert line.resting_until(1.0) == line.tick_at == pytest.approx(1.0 + GAP)
    assert line.resting_until(2.0) == 2.0


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


LAST, OF_3 = ServoMove(20, [(1, 49), (2, 49)]), ServoMove(20, [(3, 49)])


test_the_latest_command_takes_the_place_of_others = told(
    {
        "it takes the place of what it covers": [
            *[want(STOP), send(0.0, STOP)],
            *(want(ServoMove(20, [(1, n), (2, n)]), latest=True) for n in range(50)),
            *(want(ServoMove(20, [(3, n)]), latest=True) for n in range(50)),
            *[send(1.0, LAST), send(2.0, OF_3), idle, counted(replaced=98)],
        ],
        "of what names the same servos or fewer": [
            *[want(STOP), send(0.0, STOP)],
            *(want(busservo.ServoUnload(n), latest=True) for n in ([1, 2], [3], [2, 1], [4, 2, 1])),
            *[
                send(1.0, busservo.ServoUnload([3])),
                send(2.0, busservo.ServoUnload([4, 2, 1])),
                idle,
            ],
        ],
    }
)


WRONG = [("baud", 0), ("baud", -1), ("baud", math.nan), ("reply_timeout", 0), ("report_limit", 0)]


@in_turn("name, value", lambda: [*WRONG, ("settle", -1), ("settle", math.nan)])
def test_invalid_settings_are_refused(name: str, value: float) -> None:
    with pytest.raises(ValueError, match="must be"):
        session("busservo", **{name: value})


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
        assert exchange.reply_size(ServoPositionsRead(range(asked))) == size
