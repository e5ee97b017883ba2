"""Of two replies that differ, none is chosen: the question is asked again, or ends with both."""

import math
import pickle
from typing import NamedTuple

import busservo
import pytest
from busservo import BatteryVoltage, BatteryVoltageRead, DoubtfulReplyError, NoReplyError
from busservo._exchanges import EXCHANGES
from framewire.client.exchange import Exchange
from framewire.client.request import Request
from framewire.client.session import Session

from tests.in_turn import in_turn
from tests.lines.questions import IN_TIME, REPLY_TIMEOUT, TOO_SOON, TRIP, ask, say, session

# As soon as the late reply to a question that has timed out is overdue, the next is sent.
OVERDUE = 2 * (TRIP + REPLY_TIMEOUT)


# ---------------------------------------------------------------- what is in doubt, and what not
class Doubt(NamedTuple):
    """A question at 0 s, the replies to it, and its answer; None where it is asked again.

    `lost` says that the one before it got no reply, `healthy` how many before that were answered.
    """

    replies: list[tuple[float, int]]
    answer: int | None
    healthy: int = 8
    lost: bool = False
    baud: float = 9600


OWN, OTHER = 2, 1
DOUBTS = {
    "the late one behind its own": Doubt([(IN_TIME, OWN), (0.08, OTHER)], None, lost=True),
    "the late one before its own": Doubt([(IN_TIME, OTHER), (0.03, OWN)], None, lost=True),
    "both say the same": Doubt([(IN_TIME, OWN), (0.08, OWN)], OWN, lost=True),
    "both at once": Doubt([(0.1, OTHER), (0.1, OWN)], None),
    "three at once, two of them the same": Doubt([(0.1, OWN), (0.1, OTHER), (0.1, OWN)], None),
    "both at once, and the same": Doubt([(0.1, OWN), (0.1, OWN)], OWN),
    "the first is too soon": Doubt([(TOO_SOON, OTHER), (0.03, OWN)], OWN),
    "the first is too soon, behind one that was lost": Doubt(
        [(TOO_SOON, OTHER), (0.03, OWN)], OWN, lost=True
    ),
    "the first is too soon, on a line of which nothing is known": Doubt(
        [(TOO_SOON, OTHER), (0.03, OWN)], None, healthy=0
    ),
    "both at once, on a line without a pace": Doubt([(0, OTHER), (0, OWN)], None, baud=math.inf),
}


def prepared(healthy: int, *, lost: bool = False, baud: float = 9600) -> Session:
    """Return a line on which questions were answered in time, and the last was lost perhaps."""
    line = session(baud=baud)
    for number in range(healthy):
        ask(line, number - 20.0)
        say(line, number - 20.0 + TRIP, 7500)
    if lost:
        request = ask(line, -OVERDUE)
        line.tick(-OVERDUE + TRIP + REPLY_TIMEOUT)
        assert isinstance(request.error, NoReplyError)
    return line


@in_turn("name", lambda: DOUBTS)
def test_a_question_in_doubt_is_asked_again(name: str) -> None:
    doubt = DOUBTS[name]
    line = prepared(doubt.healthy, lost=doubt.lost, baud=doubt.baud)
    request = ask(line)
    for at in dict.fromkeys(at for at, _ in doubt.replies):
        say(line, at, *(voltage for when, voltage in doubt.replies if when == at))
    if doubt.answer is not None:
        assert request.reply == BatteryVoltage(doubt.answer)
        return
    assert not request.done
    now = max(at for at, _ in doubt.replies)
    assert line.outgoing(now) == [BatteryVoltageRead().encode()]
    line.written(request, now)
    say(line, now + TRIP, 3)
    assert request.reply == BatteryVoltage(3)
    # All that may come has come: nothing is waited for.
    ask(line, now + TRIP)


def test_an_only_reply_as_late_as_the_lost_one_is_not_believed() -> None:
    line = prepared(8, lost=True)
    request = ask(line)
    say(line, 0.08, OTHER)
    line.tick(TRIP + REPLY_TIMEOUT)
    assert line.outgoing(TRIP + REPLY_TIMEOUT) == [BatteryVoltageRead().encode()]
    line.written(request, TRIP + REPLY_TIMEOUT)
    say(line, 2 * TRIP + REPLY_TIMEOUT, OWN)
    line.tick(2 * OVERDUE)
    assert request.reply == BatteryVoltage(OWN)


# ---------------------------------------------------------------- how it ends
def always_in_doubt(line: Session) -> Request:
    request, now = ask(line), 0.0
    while not request.done:
        say(line, now + 0.1, OTHER, OWN)
        now += 0.1
        if line.outgoing(now):
            line.written(request, now)
    return request


def test_a_question_that_stays_in_doubt_ends_with_all_that_came() -> None:
    request = always_in_doubt(prepared(8))
    error = request.error
    assert isinstance(error, DoubtfulReplyError)
    assert error.replies == (BatteryVoltage(OTHER), BatteryVoltage(OWN))
    assert (error.request, error.attempts) == (BatteryVoltageRead(), 3)
    assert str(error) == (
        "BatteryVoltage(voltage_mv=1) and BatteryVoltage(voltage_mv=2) came within 0.300 s to "
        "3 requests of BatteryVoltageRead(), and nothing shows which is the answer; one may be "
        "late, or two devices answer: ask again"
    )
    again = pickle.loads(pickle.dumps(error))  # noqa: S301 - our own
    assert (type(again), str(again), again.replies) == (type(error), str(error), error.replies)


def test_what_is_only_confirmed_is_not_done_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(EXCHANGES[BatteryVoltageRead], "is_query", False)
    request = always_in_doubt(prepared(8))
    assert isinstance(request.error, DoubtfulReplyError)
    assert request.attempts == 1


def test_a_reply_that_repeats_its_request_confirms_it_alone() -> None:
    asked = Exchange("ask", (), reply=BatteryVoltage)
    told = Exchange("tell", (), reply=BatteryVoltage, echoed=(("voltage_mv", "voltage_mv"),))
    parts = EXCHANGES[busservo.ServoPositionsRead]
    assert (asked.is_query, told.is_query, parts.is_query) == (True, False, True)
