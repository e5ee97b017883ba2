"""A reply must be possible: what the wire cannot have carried yet was meant for somebody else."""

from __future__ import annotations

import logging
import math
from typing import TYPE_CHECKING

import pytest
from busservo import (
    ActionGroupCompleted,
    BatteryVoltage,
    BatteryVoltageRead,
    NoReplyError,
    ServoMove,
    ServoPositions,
    ServoPositionsRead,
)
from busservo._library import LIBRARY
from framewire.client.session import Session

from tests.in_turn import in_turn
from tests.lines.questions import ask

if TYPE_CHECKING:
    from busservo import Message
    from framewire.client.request import Request

REPLY_TIMEOUT = 0.25
# Question and reply of a battery on the wire: 4 bytes and 6, at 960 a second.
TRIP = 10 / 960
# Just before the wire can have carried them, and just after.
TOO_SOON, IN_TIME = 0.94 * TRIP, 0.96 * TRIP


def session(baud: float = 9600, **settings: float) -> Session:
    return Session(LIBRARY, baud=baud, reply_timeout=REPLY_TIMEOUT, report_limit=16, **settings)  # type: ignore[arg-type]


def say(line: Session, now: float, *messages: Message) -> None:
    line.receive(b"".join(each.encode() for each in messages), now)


def settle(line: Session) -> float:
    """Let time pass until nothing is left to be decided, and return the time then."""
    now = 0.0
    while (tick_at := line.tick_at) is not None:
        now = tick_at
        line.tick(now)
    return now


def answered(line: Session, now: float, voltage: int, after: float = IN_TIME) -> Request:
    """Send a question, with one reply alone `after` seconds later."""
    request = ask(line, now)
    say(line, now + after, BatteryVoltage(voltage))
    settle(line)
    return request


def test_a_reply_that_the_wire_can_have_carried_is_the_answer_at_once() -> None:
    line = session()
    request = ask(line, 0.0)
    say(line, IN_TIME, BatteryVoltage(7500))
    assert request.reply == BatteryVoltage(7500)
    assert line.counters.impossible == line.counters.unsolicited == 0


def on_a_wire() -> Session:
    """Return a line that has kept its rate so far."""
    line = session()
    answered(line, -1.0, 7500)
    return line


def test_of_an_impossible_reply_and_a_second_one_the_second_is_the_answer() -> None:
    line = on_a_wire()
    request = ask(line, 0.0)
    say(line, TOO_SOON, BatteryVoltage(1))
    assert not request.done
    say(line, 0.2, BatteryVoltage(2))
    assert request.reply == BatteryVoltage(2)
    assert (line.counters.impossible, line.counters.unsolicited) == (1, 1)


def test_an_impossible_reply_alone_is_the_answer_once_the_line_has_been_quiet() -> None:
    line = session()
    request = ask(line, 0.0)
    say(line, TOO_SOON, BatteryVoltage(7500))
    line.tick(TRIP + REPLY_TIMEOUT - 1e-6)
    assert not request.done
    line.tick(TRIP + REPLY_TIMEOUT)
    assert request.reply == BatteryVoltage(7500)
    assert (line.counters.impossible, line.counters.unsolicited) == (1, 0)


def test_a_longer_reply_timeout_is_no_reason_to_hold_a_reply_for_longer() -> None:
    line = Session(LIBRARY, baud=9600, reply_timeout=60, report_limit=16)
    request = ask(line, 0.0)
    say(line, TOO_SOON, BatteryVoltage(7500))
    line.tick(TRIP + REPLY_TIMEOUT)
    assert request.reply == BatteryVoltage(7500)


def test_a_duplicate_behind_a_reply_never_becomes_the_next_answer() -> None:
    """Six servos in a tight loop: each reply comes, and the one that came twice is dropped."""
    line = session()
    there, back = 11 / 960, 23 / 960
    request = ask(line, 0.0, ServoPositionsRead(range(1, 7)))
    now = there + back
    say(line, now, ServoPositions([(servo, 1) for servo in range(1, 7)]))
    assert request.done
    for number in range(2, 12):
        request = ask(line, now, ServoPositionsRead(range(1, 7)))
        if number == 2:
            say(line, now + back, ServoPositions([(servo, 1) for servo in range(1, 7)]))
        now += 2 * back if number == 2 else there + back
        say(line, now, ServoPositions([(servo, number) for servo in range(1, 7)]))
        assert request.reply == ServoPositions([(servo, number) for servo in range(1, 7)])
    assert line.counters.unsolicited == 1


def test_of_several_replies_that_are_read_at_once_none_is_the_answer() -> None:
    line = on_a_wire()
    request = ask(line, 0.0)
    # As where this process was stopped: it reads all that has come meanwhile, the late one too.
    say(line, 1.0, BatteryVoltage(1), ActionGroupCompleted(8, 1), BatteryVoltage(2))
    assert not request.done
    assert (line.counters.unsolicited, line.counters.retries) == (2, 1)
    assert line.reports.take() == ActionGroupCompleted(8, 1)


def test_what_came_before_the_question_was_sent_is_not_even_held() -> None:
    line = session(math.inf)
    request = ask(line, 1.0)
    say(line, 0.999, BatteryVoltage(1))
    assert line.counters.unsolicited == 1
    say(line, 1.0, BatteryVoltage(2))
    assert request.reply == BatteryVoltage(2)


def test_the_frames_before_a_question_take_their_time_as_well() -> None:
    line = on_a_wire()
    move = ServoMove(100, [(servo, 500) for servo in range(1, 7)])
    line.submit(move)
    line.submit(BatteryVoltageRead())
    line.outgoing(0.0)
    before = len(move.encode()) / 960
    (frame,) = line.outgoing(before)
    assert frame == BatteryVoltageRead().encode()
    line.receive(BatteryVoltage(1).encode(), before * 0.95 + TOO_SOON)
    line.receive(BatteryVoltage(2).encode(), before + TRIP)
    assert line.counters.unsolicited == 1


def test_a_further_attempt_takes_the_late_reply_to_the_first() -> None:
    line = session()
    request = ask(line, 0.0, retries=1)
    line.tick(TRIP + REPLY_TIMEOUT)
    line.outgoing(TRIP + REPLY_TIMEOUT)
    say(line, TRIP + REPLY_TIMEOUT + 0.001, BatteryVoltage(7500))
    assert request.reply == BatteryVoltage(7500)


def test_a_line_is_fast_after_three_questions_with_one_impossible_reply_each() -> None:
    line = session()
    for number in range(3):
        assert answered(line, number, 7500 + number, 0.001).reply == BatteryVoltage(7500 + number)
    request = ask(line, 3.0)
    say(line, 3.001, BatteryVoltage(7503))
    assert request.reply == BatteryVoltage(7503)
    assert line.counters.impossible == 3


@in_turn("between, more", lambda: [("in time", 2), ("not at all", 2), ("twice", 1)])
def test_only_three_impossible_replies_in_a_row_make_a_line_fast(between: str, more: int) -> None:
    line = session()
    answered(line, 0.0, 1, 0.001)
    answered(line, 1.0, 2, 0.001)
    if between == "in time":
        answered(line, 2.0, 3)
    else:
        ask(line, 2.0)
        if between == "twice":  # the second of which is one reply again
            say(line, 2.001, BatteryVoltage(3))
            say(line, 2.002, BatteryVoltage(3))
        settle(line)
    for number in range(more):
        assert not answered(line, 4.0 + number, 4, 0.001).error
    request = ask(line, 8.0)
    say(line, 8.001, BatteryVoltage(5))
    assert not request.done
    settle(line)
    request = ask(line, 9.0)
    say(line, 9.001, BatteryVoltage(6))
    assert request.done


def test_a_surplus_reply_ends_what_was_learnt() -> None:
    line = session()
    for number in range(3):
        answered(line, number, 7500, 0.001)
    say(line, 3.0, BatteryVoltage(1))
    request = ask(line, 4.0)
    say(line, 4.001, BatteryVoltage(2))
    assert not request.done
    settle(line)
    assert request.reply == BatteryVoltage(2)


def test_another_line_is_learnt_anew() -> None:
    line = session()
    for number in range(3):
        answered(line, number, 7500, 0.001)
    line.restart(3.0)
    request = ask(line, 4.0)
    say(line, 4.001, BatteryVoltage(2))
    assert not request.done


def test_on_a_line_that_keeps_its_rate_an_impossible_reply_is_no_answer_at_all() -> None:
    """One that came twice, and then one that is lost: the question ends with an error."""
    line = session()
    for number in range(8):
        answered(line, number, 7500)
    request = answered(line, 9.0, 1, TOO_SOON)
    assert isinstance(request.error, NoReplyError)
    assert "1 reply came that cannot be the answer" in str(request.error)
    assert line.counters.unsolicited == 1
    assert answered(line, 10.0, 7501).reply == BatteryVoltage(7501)


def test_a_line_that_has_become_fast_is_learnt_again() -> None:
    line = session()
    for number in range(8):
        answered(line, number, 7500)
    ends = [answered(line, 10.0 + 2 * number, number, 0.001).reply for number in range(4)]
    assert ends == [None, None, BatteryVoltage(2), BatteryVoltage(3)]


def test_a_line_that_takes_no_time_says_so() -> None:
    line = session(math.inf)
    for number in range(8):
        request = ask(line, number)
        say(line, number, BatteryVoltage(number))
        assert request.reply == BatteryVoltage(number)
    assert line.counters.impossible == 0


def test_after_a_reply_that_never_came_the_next_is_held() -> None:
    line = session()
    ask(line, 0.0)
    now = settle(line)  # no reply, and none late
    line.tick(2 * now)
    request = ask(line, 2 * now)
    say(line, 2 * now + 0.1, BatteryVoltage(1))  # much too late, but possible
    assert not request.done
    # Which of the two is its own, nothing shows: test_doubtful_replies has the rest.
    say(line, 2 * now + 0.12, BatteryVoltage(2))
    assert not request.done
    assert line.outgoing(2 * now + 0.12) == [request.message.encode()]


def test_after_a_reply_that_never_came_the_next_alone_is_the_answer() -> None:
    line = session()
    ask(line, 0.0)
    now = settle(line)
    line.tick(2 * now)
    assert answered(line, 2 * now, 7500).reply == BatteryVoltage(7500)
    request = ask(line, 5.0)
    say(line, 5.0 + IN_TIME, BatteryVoltage(7501))
    assert request.reply == BatteryVoltage(7501)


def test_a_reply_that_is_held_is_no_answer_to_what_was_cancelled() -> None:
    line = session()
    request = ask(line, 0.0)
    say(line, TOO_SOON, BatteryVoltage(1))
    line.cancel(request)
    assert line.counters.unsolicited == 1
    line.submit(BatteryVoltageRead())
    assert line.outgoing(0.1) == []


def slow_board(line: Session, latency: float, reads: int) -> float:
    """Read from a board that needs time for each answer, in a loop without a pause."""
    now = 0.0
    for number in range(reads):
        request = ask(line, now)
        now += TRIP + latency
        say(line, now, BatteryVoltage(number))
        assert request.reply == BatteryVoltage(number)
    return now


def test_a_foreign_reply_in_the_time_of_the_right_one_makes_one_read_stale_and_no_more() -> None:
    """A board that thinks for longer than a question takes: all replies of a shift are possible."""
    line, latency = session(), 0.02
    now = slow_board(line, latency, 8)
    request = ask(line, now)
    right_at = now + TRIP + latency
    say(line, now + TRIP + 0.002, BatteryVoltage(1))
    assert request.reply == BatteryVoltage(1)  # indistinguishable
    request = line.submit(BatteryVoltageRead())
    assert line.outgoing(now + TRIP + 0.002) == []
    say(line, right_at, BatteryVoltage(9))
    assert line.counters.unsolicited == 1
    assert line.outgoing(right_at) == [request.message.encode()]
    line.written(request, right_at)
    say(line, right_at + TRIP + latency, BatteryVoltage(10))
    assert request.reply == BatteryVoltage(10)


def test_the_right_reply_has_as_long_as_the_slowest_of_the_latest() -> None:
    line, now = session(), 0.0
    for number, latency in enumerate([0.02, 0.035, 0.02, 0.03, 0.025]):
        request = ask(line, now)
        now += TRIP + latency
        say(line, now, BatteryVoltage(number))
        assert request.done
    ask(line, now)
    early = now + TRIP + 0.002
    say(line, early, BatteryVoltage(1))
    line.submit(BatteryVoltageRead())
    at = line.send_at(early)
    assert at is not None
    assert at >= now + TRIP + 0.035


@in_turn("in_time, believed", lambda: [(7, True), (8, False)])
def test_a_line_keeps_its_rate_after_eight_questions_in_a_row(in_time: int, believed: bool) -> None:
    line = session()
    answered(line, 0.0, 1, TOO_SOON)
    for number in range(in_time):
        answered(line, 1.0 + number, 7500)
    assert (answered(line, 20.0, 2, TOO_SOON).reply is not None) is believed


def test_a_board_that_is_quick_for_once_costs_a_moment_and_nothing_else() -> None:
    line, latency = session(), 0.02
    now = slow_board(line, latency, 8)
    answered(line, now, 7500, TRIP + 0.002)
    request = line.submit(BatteryVoltageRead())
    at = line.send_at(now + TRIP + 0.002)
    assert at is not None
    assert at < now + TRIP + latency + 0.01
    line.outgoing(at)
    line.written(request, at)
    say(line, at + TRIP + 0.002, BatteryVoltage(7501))
    assert request.reply == BatteryVoltage(7501)
    ask(line, at + TRIP + 0.002)  # it is usual now, and costs nothing more


# ---------------------------------------------------------------- what was there before


def test_a_first_question_waits_until_replies_to_others_have_come() -> None:
    line = session(now=10.0)
    request = line.submit(BatteryVoltageRead())
    assert line.outgoing(10.0) == []
    say(line, 10.01, BatteryVoltage(5000))  # requested by a program that was killed
    at = line.send_at(10.01)
    assert at == pytest.approx(10 + TRIP + REPLY_TIMEOUT)
    assert at is not None
    assert line.outgoing(at) == [BatteryVoltageRead().encode()]
    line.written(request, at)
    say(line, at + TRIP, BatteryVoltage(7401))
    assert request.reply == BatteryVoltage(7401)
    assert line.counters.unsolicited == 1


def test_a_question_that_comes_later_does_not_wait() -> None:
    line = session(now=10.0)
    ask(line, 10.0 + TRIP + REPLY_TIMEOUT)


def test_a_question_behind_a_command_does_not_wait_on_a_quiet_line() -> None:
    line = session(now=10.0)
    line.submit(ServoMove(100, [(1, 500)]))
    line.submit(BatteryVoltageRead())
    assert len(line.outgoing(10.0)) == 1
    assert len(line.outgoing(10.02)) == 1


def test_a_question_behind_a_command_waits_where_something_was_received() -> None:
    line = session(now=10.0)
    say(line, 10.0, BatteryVoltage(5000))
    line.submit(ServoMove(100, [(1, 500)]))
    line.submit(BatteryVoltageRead())
    assert len(line.outgoing(10.0)) == 1
    assert line.outgoing(10.02) == []
    assert len(line.outgoing(10.0 + TRIP + REPLY_TIMEOUT)) == 1


@pytest.mark.parametrize(("given", "waits"), [(0.0, 0.0), (1.5, 1.5)])
def test_the_settling_time_can_be_set(given: float, waits: float) -> None:
    line = session(now=10.0, settle=given)
    line.submit(BatteryVoltageRead())
    if waits:
        assert line.outgoing(10.0 + waits - 0.001) == []
    assert len(line.outgoing(10.0 + waits)) == 1


def test_a_line_that_was_opened_again_settles_again() -> None:
    line = session(now=0.0)
    answered(line, 1.0, 7500)
    line.restart(5.0)
    line.submit(BatteryVoltageRead())
    assert line.outgoing(5.1) == []
    assert len(line.outgoing(5.0 + TRIP + REPLY_TIMEOUT)) == 1


@in_turn("settle", lambda: [-1, math.nan])
def test_a_negative_settling_time_is_refused(settle: float) -> None:
    with pytest.raises(ValueError, match="settle is"):
        session(settle=settle)


# ---------------------------------------------------------------- what is said


def test_what_is_dropped_and_why_is_logged(caplog: pytest.LogCaptureFixture) -> None:
    line = session()
    with caplog.at_level(logging.DEBUG, "busservo"):
        ask(line, 0.0)
        say(line, TOO_SOON, BatteryVoltage(1))
        say(line, TRIP, BatteryVoltage(2))
    assert "came sooner than the wire allows" in caplog.text
    assert "dropped BatteryVoltage(voltage_mv=1)" in caplog.text


@in_turn(
    "came, expected",
    lambda: [
        (b"", "nothing came at all: is the device switched on"),
        (b"\xf0" * 336, "336 bytes came that are no frame: wrong baud rate?"),
        (b"\x00", "1 byte came that is no frame"),
        (ActionGroupCompleted(8, 1).encode(), "1 report came, so the device can be heard"),
        (ServoPositions([(9, 1)]).encode(), "1 reply came that cannot be the answer"),
        (b"\x55\x55\x09\x15", "4 bytes came that are no frame"),
    ],
)
def test_a_missing_reply_says_what_came_instead(came: bytes, expected: str) -> None:
    line = session(now=0.0, settle=0)
    say(line, 0.0, ActionGroupCompleted(1, 1))  # before the question, and none of its business
    request = ask(line, 0.0)
    line.receive(came, 0.2)
    settle(line)
    assert isinstance(request.error, NoReplyError)
    assert expected in str(request.error)
    if came:
        assert "nothing came" not in str(request.error)
