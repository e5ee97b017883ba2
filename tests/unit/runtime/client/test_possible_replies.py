"""A reply must be possible: what the wire cannot have carried yet was meant for somebody else."""

import logging
import math
from typing import Any, NamedTuple

import busservo
import pytest
from busservo import ActionGroupCompleted, BatteryVoltage, BatteryVoltageRead, NoReplyError
from framewire.client.session import Session

from tests.in_turn import in_turn
from tests.lines import questions
from tests.lines import stories as story
from tests.lines.questions import IN_TIME, REPLY_TIMEOUT, TOO_SOON, TRIP, ask, say, session, settle

QUESTION = BatteryVoltageRead().encode()
# Far too soon: where it is not said that the line is fast, no reply can have come.
FAST = 0.001
LOST, TWICE, SURPLUS, REOPENED = "lost", "twice", "surplus", "reopened"


class Story(NamedTuple):
    """Earlier questions, by when the one reply to each came; and then one, and all its replies.

    Its answer is there at once, or `at_last`, once the line has been quiet, or never.
    """

    earlier: list[float | str]
    replies: list[tuple[float, int]]
    at_once: int | None = None
    at_last: int | None = None
    impossible: int = 0
    unsolicited: int = 0


STORIES = {
    "in time": Story([], [(IN_TIME, 1)], 1),
    "too soon": Story([], [(TOO_SOON, 1)], None, 1, 1),
    "too soon, and then its own": Story([IN_TIME], [(TOO_SOON, 1), (0.2, 2)], 2, None, 1, 1),
    "too soon for the fourth time": Story([FAST] * 3, [(FAST, 4)], 4, None, 3),
    "too soon for the third time": Story([FAST] * 2, [(FAST, 3)], None, 3, 3),
    "not all in a row": Story([FAST, FAST, IN_TIME, FAST, FAST], [(FAST, 5)], None, 5, 5),
    "not all were answered": Story([FAST, FAST, LOST, FAST, FAST], [(FAST, 5)], None, 5, 5),
    "one came twice, and counts": Story([FAST, FAST, TWICE, FAST], [(FAST, 5)], None, 5, 5, 1),
    "three in a row again": Story([FAST, FAST, IN_TIME, *[FAST] * 3], [(FAST, 5)], 5, None, 5),
    "one too many": Story([FAST] * 3 + [SURPLUS], [(FAST, 1)], None, 1, 4),
    "on another line": Story([FAST] * 3 + [REOPENED], [(FAST, 1)], None, 1, 4),
    "not yet known to keep its rate": Story(
        [TOO_SOON, *[IN_TIME] * 7], [(TOO_SOON, 1)], None, 1, 2
    ),
    "known to keep its rate": Story([TOO_SOON, *[IN_TIME] * 8], [(TOO_SOON, 1)], None, None, 2, 1),
    "it has become fast": Story([*[IN_TIME] * 8, FAST, FAST], [(FAST, 1)], None, 1, 3, 2),
    "it has become fast, and that is known": Story(
        [*[IN_TIME] * 8, *[FAST] * 3], [(FAST, 1)], 1, None, 3, 2
    ),
    # Which of the two is its own, nothing shows: test_doubtful_replies has the rest.
    "behind one that was lost, two": Story([LOST], [(0.1, 1), (0.12, 2)], None, None, 0, 2),
    "behind one that was lost": Story([LOST], [(IN_TIME, 1)], None, 1),
    "behind one that was lost, and one that was not": Story([LOST, IN_TIME], [(IN_TIME, 1)], 1),
}


def happened(line: Session, at: float, what: float | str) -> None:
    """Let one of the earlier questions be asked, or what there is besides."""
    if isinstance(what, float):
        questions.answered(line, at, 7500, what)
    elif what == SURPLUS:
        say(line, at, 7500)
    elif what == REOPENED:
        line.restart(at)
    else:
        ask(line, at)
        for after in (FAST, 2 * FAST) if what == TWICE else ():
            say(line, at + after, 7500)
        settle(line)


@in_turn("name", lambda: STORIES)
def test_a_reply_is_the_answer_where_the_wire_can_have_carried_it(name: str) -> None:
    earlier, replies, at_once, at_last, impossible, unsolicited = STORIES[name]
    line = session()
    for number, each in enumerate(earlier):
        happened(line, 2.0 * (number - len(earlier)), each)
    request = ask(line)
    for after, voltage in replies:
        say(line, after, voltage)
    assert request.reply == (at_once and BatteryVoltage(at_once))
    settle(line)
    answer = at_once or at_last
    assert request.reply == (answer and BatteryVoltage(answer))
    assert (line.counters.impossible, line.counters.unsolicited) == (impossible, unsolicited)


SETTLED = TRIP + REPLY_TIMEOUT
MOVE, REPORT = busservo.ServoMove(100, [(1, 500)]), ActionGroupCompleted(8, 1)
SIX_MOVED = busservo.ServoMove(100, [(servo, 500) for servo in range(1, 7)])
BEFORE = len(SIX_MOVED.encode()) / 960
HEALTHY = [story.ask(-1.0), story.hear(IN_TIME - 1.0, 7500), story.replied(7500)]
HELD = [
    *[story.ask(), story.hear(TOO_SOON, 7500), story.tick(SETTLED - 1e-6), story.pending],
    *[story.tick(SETTLED), story.replied(7500)],
]
test_an_impossible_reply = story.told(
    {
        "is held until the line has been quiet": HELD,
        "ends alone, on a line that keeps its rate, with an error that says so": [
            *(step for n in range(8) for step in (story.ask(n), story.hear(n + IN_TIME, 7500))),
            *[story.ask(9), story.hear(9 + TOO_SOON, 1), story.settled],
            story.failed(NoReplyError, "1 reply came that cannot be the answer"),
            *[story.ask(10), story.hear(10 + IN_TIME, 7501), story.settled],
            story.replied(7501),
        ],
        # As where this process was stopped: it reads all that has come meanwhile, the late one too.
        "is each of several that are read at once": [
            *[*HEALTHY, story.ask(), story.hear(1.0, 1, REPORT, 2), story.pending],
            *[story.counted(unsolicited=2, retries=1), story.reported(REPORT)],
        ],
        "is one that came while frames before the question took their time": [
            *[*HEALTHY, story.want(SIX_MOVED), story.want(), story.send(0.0, SIX_MOVED)],
            *[story.send(BEFORE, story.QUESTION), story.hear(BEFORE * 0.95 + TOO_SOON, 1)],
            *[story.hear(BEFORE + TRIP, 2), story.counted(unsolicited=1)],
        ],
        "is no answer to what was cancelled": [
            *[story.ask(), story.hear(TOO_SOON, 1), story.cancel(), story.counted(unsolicited=1)],
            *[story.want(), story.send(0.1)],
        ],
        "is not known of a line that was opened again, which settles again": [
            *[story.ask(1.0), story.hear(1.0 + IN_TIME, 7500), story.restart(5.0), story.want()],
            *[story.send(5.1), story.send(5.0 + SETTLED, story.QUESTION)],
        ],
    }
)
test_it_is_held_no_longer_for_a_longer_reply_timeout = story.told({"": HELD}, reply_timeout=60)
test_what_came_before_the_question_was_sent_is_not_even_held = story.told(
    {
        "": [
            *[story.ask(1.0), story.hear(0.999, 1), story.counted(unsolicited=1)],
            *[story.hear(1.0, 2), story.replied(2)],
        ]
    },
    baud=math.inf,
)


# ---------------------------------------------------------------- what was there before
@in_turn(
    "given, heard, behind_a_command, after",
    lambda: [
        ({}, False, False, SETTLED),
        # Requested by a program that was killed.
        ({}, True, False, SETTLED),
        ({}, True, True, SETTLED),
        # On a quiet line, it goes once the command has all but left.
        ({}, False, True, len(MOVE.encode()) / 960 - 0.004),
        ({"settle": 0.0}, False, False, 0.0),
        ({"settle": 1.5}, False, False, 1.5),
    ],
)
def test_a_first_question_waits_until_replies_to_others_have_come(
    given: dict[str, Any], heard: bool, behind_a_command: bool, after: float
) -> None:
    line = session(now=10.0, **given)
    if heard:
        say(line, 10.0, 5000)
    if behind_a_command:
        line.submit(MOVE)
        assert line.outgoing(10.0) == [MOVE.encode()]
    request = line.submit(BatteryVoltageRead())
    at = line.send_at(10.0)
    assert at is not None
    at = max(10.0, at)
    assert at == pytest.approx(10.0 + after)
    if after:
        assert line.outgoing(at - 1e-6) == []
    assert line.outgoing(at) == [QUESTION]
    line.written(request, at)
    say(line, request.left_at + 6 / 960, 7401)
    assert request.reply == BatteryVoltage(7401)
    assert line.counters.unsolicited == heard


# ---------------------------------------------------------------- what is said
def test_what_is_dropped_and_why_is_logged(caplog: pytest.LogCaptureFixture) -> None:
    line = session()
    with caplog.at_level(logging.DEBUG, "busservo"):
        ask(line)
        say(line, TOO_SOON, 1)
        say(line, TRIP, 2)
    assert "came sooner than the wire allows" in caplog.text
    assert "dropped BatteryVoltage(voltage_mv=1)" in caplog.text


@in_turn(
    "came, expected",
    lambda: [
        (b"", "nothing came at all: is the device switched on"),
        (b"\xf0" * 336, "336 bytes came that are no frame: wrong baud rate?"),
        (b"\x00", "1 byte came that is no frame"),
        (ActionGroupCompleted(8, 1).encode(), "1 report came, so the device can be heard"),
        (busservo.ServoPositions([(9, 1)]).encode(), "1 reply came that cannot be the answer"),
        (b"\x55\x55\x09\x15", "4 bytes came that are no frame"),
    ],
)
def test_a_missing_reply_says_what_came_instead(came: bytes, expected: str) -> None:
    line = session(now=0.0, settle=0)
    say(line, 0.0, ActionGroupCompleted(1, 1))  # before the question, and none of its business
    request = ask(line)
    say(line, 0.2, came)
    settle(line)
    assert isinstance(request.error, NoReplyError)
    assert expected in str(request.error)
    assert ("nothing came" in str(request.error)) is (not came)
