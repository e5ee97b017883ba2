"""The reports that are kept, and which of them satisfies a wait."""

import math

import busservo
from busservo import ActionGroupCompleted, ActionGroupRun, ActionGroupStopped, Message
from busservo._library import CODEC, LIBRARY
from framewire.client.report_filter import Kinds, ReportFilter
from framewire.client.session import Session

from tests.in_turn import in_turn
from tests.lines.questions import say, session

RUN_8, RUN_9, STOP = ActionGroupRun(8, 1), ActionGroupRun(9, 1), busservo.ActionGroupStop()
STARTED_8 = busservo.ActionGroupStarted(8, 1)
COMPLETED_8, COMPLETED_9 = ActionGroupCompleted(8, 1), ActionGroupCompleted(9, 1)
STOPPED = ActionGroupStopped()
ENDED = (ActionGroupCompleted, ActionGroupStopped)


def after(story: list[Message]) -> Session:
    """Return a session in which these commands were sent and these reports came, in this order."""
    line = session(baud=math.inf)
    for message in story:
        if message.DIRECTION is CODEC.received:
            say(line, 0.0, message)
        else:
            line.submit(message)
            line.outgoing(0.0)
    return line


def wanted(kind: Kinds, fields: dict[str, int]) -> ReportFilter:
    return ReportFilter(LIBRARY.codec.received, kind, fields)


def test_a_run_is_the_cause_of_its_reports() -> None:
    log = after([COMPLETED_8, RUN_8, COMPLETED_8, RUN_9]).reports
    of_8, of_9 = (wanted(ActionGroupCompleted, {"group": group}) for group in (8, 9))
    assert log.since(of_8) == 1
    assert log.since(of_9) == 2
    found = log.find(of_8, since=1, began_at=2)
    assert found == ActionGroupCompleted(8, 1)
    # It has been waited for: the next wait wants another.
    assert log.find(of_8, since=1, began_at=2) is None
    assert log.take() == log.take() == ActionGroupCompleted(8, 1)
    assert log.take() is None


@in_turn(
    "story, fields, found",
    lambda: [
        # The group ends by itself, or by a button.
        ([RUN_8, STARTED_8, COMPLETED_8], {"group": 8}, COMPLETED_8),
        ([RUN_8, STARTED_8, STOPPED], {"group": 8}, STOPPED),
        # What was stopped before it began reports nothing of it.
        ([STOP, STOPPED, RUN_8], {"group": 8}, None),
        ([STOP, STOPPED, RUN_8], {}, None),
        # It had ended before it was stopped, and there was nothing to stop.
        ([RUN_8, COMPLETED_8, STOP], {"group": 8}, COMPLETED_8),
        # One group has ended, and not the other.
        ([RUN_8, RUN_9, COMPLETED_9], {"group": 8}, None),
        ([RUN_8, RUN_9, COMPLETED_9], {"group": 9}, COMPLETED_9),
        # Nobody here has caused anything: what has come is over.
        ([STOPPED], {}, None),
        ([COMPLETED_8], {"group": 8}, None),
        ([STOP, STOPPED], {}, STOPPED),
    ],
)
def test_the_end_of_a_group_is_one_of_two_reports(
    story: list[Message], fields: dict[str, int], found: Message | None
) -> None:
    log, end = after(story).reports, wanted(ENDED, fields)
    since = log.since(end)
    assert log.find(end, since=since, began_at=log.next_number) == found
    assert log.find(end, since=since, began_at=log.next_number) is None


def test_what_came_instead_is_counted_but_for_what_is_over() -> None:
    log = after([STOPPED, RUN_8, STARTED_8, COMPLETED_8, COMPLETED_9, STARTED_8]).reports
    end = wanted(ActionGroupCompleted, {"group": 8})
    assert log.instead_of(end, since=log.since(end)) == {STARTED_8: 2, COMPLETED_9: 1}
