"""A message that answers a question, and comes by itself as well, is a report where it does."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import pytest
from busservo import BatteryVoltage, Message
from busservo._library import LIBRARY
from framegen.model.codec import encode
from framewire.client.session import Session

from tests.factories import data_of, files_of, layout_of, library
from tests.in_turn import in_turn
from tests.lines.questions import TRIP, ask, asked, say, session
from tests.mutations.places import having
from tests.protocols.specs import FILES

ASK = "asked"


class Story(NamedTuple):
    """What happens on a line that is opened at 0 s: questions, voltages that come, and reports."""

    steps: list[tuple[float, str | int]]
    reports: list[int]
    declared: bool = False


STORIES = {
    "never asked for": Story([(5, 1), (6, 2)], [1, 2]),
    "to a program that was killed": Story([(0.2, 1)], []),
    "long after the answer": Story([(5, ASK), (5 + TRIP, 1), (7, 2)], [2]),
    "twice": Story([(5, ASK), (5 + TRIP, 1), (5.2, 1)], []),
    "late": Story([(5, ASK), (5.4, 1)], []),
    "much too late": Story([(5, ASK), (8, 1)], []),
    "behind one that was much too late": Story([(5, ASK), (8, 1), (9, 2), (9.1, 3)], [2, 3]),
    "read long after it came, as the process was stopped": Story([(5, ASK), (8, 1), (8.1, 1)], []),
    "known to come by itself, right behind the answer": Story(
        [(5, 1), (6, ASK), (6 + TRIP, 2), (6 + 2 * TRIP, 3)], [1, 3]
    ),
    "known to come by itself, too soon for the answer": Story(
        [(5, 1), (6, ASK), (6.001, 2), (6 + TRIP, 3)], [1, 2]
    ),
    "declared, and never asked for": Story([(0.2, 1), (0.3, 2)], [1, 2], declared=True),
    "declared, right behind the answer": Story(
        [(5, ASK), (5 + TRIP, 1), (5 + 2 * TRIP, 2)], [2], declared=True
    ),
    "declared, too soon for the answer": Story(
        [(5, ASK), (5.001, 1), (5 + TRIP, 2)], [1], declared=True
    ),
}


@in_turn("name", lambda: STORIES)
def test_what_comes_by_itself_is_a_report(name: str) -> None:
    steps, expected, declared = STORIES[name]
    with pytest.MonkeyPatch.context() as patch:
        if declared:
            patch.setattr(LIBRARY, "reports", frozenset([BatteryVoltage]))
        line = session(now=0.0)
    for at, step in steps:
        while (tick_at := line.tick_at) is not None and tick_at < at:
            line.tick(tick_at)
        if isinstance(step, str):
            ask(line, at)
        else:
            say(line, at, step)
    reports = list(taken(line))
    assert reports == [BatteryVoltage(each) for each in expected]
    # Whatever came is counted, as one or the other.
    counters = line.counters
    came = sum(isinstance(step, int) for _, step in steps)
    assert counters.reports + counters.replies + counters.unsolicited == came
    assert counters.reports == len(reports)


def taken(line: Session) -> Iterator[Message]:
    while (report := line.reports.take()) is not None:
        yield report


# ------------------------------------------------------------------ a receiver
@pytest.fixture(scope="module")
def receiver() -> Iterator[Any]:
    """Import the library of a protocol whose length counts to 65535, and return its spec.

    A message comes again and again once it is switched on, and is asked for as well.
    """
    long = {"messages.MonVer.fields.extensions.count": "0.."}
    data = having(data_of(FILES["ubx"]), long | {"messages.CfgMsgRateSet.reports": ["NavPvt"]})
    with library(files_of(data)):
        yield data


def test_what_is_asked_for_and_reported_as_well_is_both(receiver: Any) -> None:
    line, _, kinds = asked("ubx", "MonVerPoll")
    frame = bytes.fromhex(receiver["messages"]["NavPvt"]["examples"][0]["hex"])
    say(line, 0.01, frame)
    assert line.reports.take() == kinds.NavPvt.decode(frame)
    assert line.counters.unsolicited == 0
    line.tick(2.0)  # what was asked first is given up
    request = ask(line, 3.0, kinds.NavPvtPoll())
    say(line, 3.2, frame)
    assert request.reply == kinds.NavPvt.decode(frame)


def test_a_long_reply_may_take_as_long_as_it_goes_on_arriving_and_no_longer(receiver: Any) -> None:
    line, request, _ = asked("ubx", "MonVerPoll")
    line.tick(2.0)
    assert "no MonVer came" in str(request.error)
    line, request, _ = asked("ubx", "MonVerPoll")
    extensions = [{"text": f"extension {number}"} for number in range(200)]
    values = {"software": "1", "hardware": "2", "extensions": extensions}
    reply = encode(layout_of(receiver).messages["MonVer"], values)
    assert len(reply) > 5000
    for at in range(0, len(reply), 96):
        say(line, 0.1 + at / 960, reply[at : at + 96])
        line.tick(0.1 + at / 960 + 0.001)
    assert request.error is None
    assert len(request.reply.extensions) == 200
