"""A message that answers a question, and comes by itself as well, is a report where it does."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import pytest
from busservo import BatteryVoltage, BatteryVoltageRead, Controller, ServoPositions
from busservo._library import LIBRARY
from framewire.client.session import Session

from tests.lines.questions import ask
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine

if TYPE_CHECKING:
    from collections.abc import Iterator

    from busservo import Message

REPLY_TIMEOUT = 0.25
TRIP = 10 / 960
ASK = "asked"


class Story(NamedTuple):
    """What happens on a line that is opened at 0 s: questions, voltages that come, and reports."""

    steps: list[tuple[float, str | int]]
    reports: list[int]
    declared: bool = False


LONG = 5.0
STORIES = {
    "never asked for": Story([(LONG, 1), (LONG + 1, 2)], [1, 2]),
    "to a program that was killed": Story([(0.2, 1)], []),
    "long after the answer": Story([(LONG, ASK), (LONG + TRIP, 1), (LONG + 2, 2)], [2]),
    "twice": Story([(LONG, ASK), (LONG + TRIP, 1), (LONG + 0.2, 1)], []),
    "late": Story([(LONG, ASK), (LONG + 0.4, 1)], []),
    "much too late": Story([(LONG, ASK), (LONG + 3, 1)], []),
    "behind one that was much too late": Story(
        [(LONG, ASK), (LONG + 3, 1), (LONG + 4, 2), (LONG + 4.1, 3)], [2, 3]
    ),
    "read long after it came, as the process was stopped": Story(
        [(LONG, ASK), (LONG + 3, 1), (LONG + 3.1, 1)], []
    ),
    "known to come by itself, right behind the answer": Story(
        [(LONG, 1), (LONG + 1, ASK), (LONG + 1 + TRIP, 2), (LONG + 1 + 2 * TRIP, 3)], [1, 3]
    ),
    "known to come by itself, too soon for the answer": Story(
        [(LONG, 1), (LONG + 1, ASK), (LONG + 1.001, 2), (LONG + 1 + TRIP, 3)], [1, 2]
    ),
    "declared, and never asked for": Story([(0.2, 1), (0.3, 2)], [1, 2], declared=True),
    "declared, right behind the answer": Story(
        [(LONG, ASK), (LONG + TRIP, 1), (LONG + 2 * TRIP, 2)], [2], declared=True
    ),
    "declared, too soon for the answer": Story(
        [(LONG, ASK), (LONG + 0.001, 1), (LONG + TRIP, 2)], [1], declared=True
    ),
}


@pytest.mark.parametrize("name", STORIES)
def test_what_comes_by_itself_is_a_report(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    story = STORIES[name]
    if story.declared:
        monkeypatch.setattr(LIBRARY, "reports", frozenset([BatteryVoltage]))
    line = Session(LIBRARY, baud=9600, reply_timeout=REPLY_TIMEOUT, report_limit=16, now=0.0)
    came, asked = [], 0
    for at, step in story.steps:
        while (tick_at := line.tick_at) is not None and tick_at < at:
            line.tick(tick_at)
        if isinstance(step, str):
            asked += 1
            ask(line, at)
        else:
            came.append(step)
            line.receive(BatteryVoltage(step).encode(), at)
    reports = list(taken(line))
    assert reports == [BatteryVoltage(each) for each in story.reports]
    # Whatever came is counted, as one or the other.
    counters = line.counters
    assert counters.reports + counters.replies + counters.unsolicited == len(came)
    assert counters.reports == len(reports)


def taken(line: Session) -> Iterator[Message]:
    while (report := line.reports.take()) is not None:
        yield report


def test_a_stream_of_measurements_reaches_who_listens_and_who_asks() -> None:
    """The board sends a voltage a second by itself, and the same message for an answer."""
    line = VirtualLine()

    def answer(message: Message) -> Iterator[tuple[float, Message]]:
        if isinstance(message, BatteryVoltageRead):
            yield TRIP, BatteryVoltage(7400)
        else:
            yield TRIP, ServoPositions([(1, 500)])

    line.answer = answer
    with client_on(line, Controller, baud=9600, settle=None) as controller:
        heard: list[Message] = []
        controller.on_report(heard.append)
        assert list(controller.reports(timeout=1.0)) == []
        for second in range(1, 6):
            line.say(BatteryVoltage(second))
            assert next(controller.reports(timeout=0.5)) == BatteryVoltage(second)
            assert controller.read_battery_voltage() == 7400
        assert heard == [BatteryVoltage(second) for second in range(1, 6)]
        assert controller.counters.unsolicited == 0


def test_another_line_is_learnt_anew() -> None:
    line = Session(LIBRARY, baud=9600, reply_timeout=REPLY_TIMEOUT, report_limit=16, now=0.0)
    line.restart(LONG)
    line.receive(BatteryVoltage(1).encode(), LONG + 0.2)
    assert (line.counters.unsolicited, line.counters.reports) == (1, 0)
