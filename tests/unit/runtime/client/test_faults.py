"""No wrong value is ever returned: the right reply, or a declared error, in bounded time.

Every question that the board receives gets a value of its own, so that a reply taken for another's
shows. The faults of each answer are drawn by Hypothesis, and time is virtual.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupStarted,
    ActionGroupStopped,
    BatteryVoltage,
    BatteryVoltageRead,
    Controller,
    IncompleteReplyError,
    Message,
    NoReplyError,
    ServoPosition,
    ServoPositions,
    ServoPositionsRead,
)
from busservo.strategies import noise
from hypothesis import given
from hypothesis import strategies as st

from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine

if TYPE_CHECKING:
    from collections.abc import Iterator

REPLY_TIMEOUT = 0.25
REPORTS = [ActionGroupStarted(8, 1), ActionGroupStopped(), ActionGroupCompleted(8, 1)]


@dataclass
class Fault:
    """A fault of one answer."""

    dropped: bool
    late: float
    before: bytes
    after: bytes
    reports: list[Message]
    left_out: int
    cut: int
    gap: float


faults = st.builds(
    Fault,
    dropped=st.sampled_from([False, False, False, True]),
    # As a share of the time that the client allows; what is later than twice that, no client that
    # numbers nothing can distinguish from the next reply.
    late=st.sampled_from([0.0, 0.0, 0.2, 0.8, 1.05, 1.5, 1.9]),
    before=st.just(b"") | noise(max_size=12) | st.just(b"\x55") | st.just(b"\x55" * 9),
    after=st.just(b"") | st.just(b"\x00\xff") | st.just(b"\x55"),
    reports=st.lists(st.sampled_from(REPORTS), max_size=4),
    left_out=st.sampled_from([0, 0, 0, 1, 6]),
    cut=st.integers(0, 30),
    gap=st.sampled_from([0.0, 0.001, 0.02]),
)

asks = st.one_of(
    st.none(), st.lists(st.integers(1, 9), min_size=1, max_size=6, unique=True), st.just([1, 2, 3])
)


def question_in_order(question: list[int] | None) -> list[int]:
    return sorted(question or [])


class FaultyBoard:
    """A board that answers each question with a number that no other answer has."""

    def __init__(self, plan: list[Fault]) -> None:
        self.plan = plan
        self.questions = 0
        self.reported: list[Message] = []

    def answer(self, message: Message) -> Iterator[tuple[float, bytes]]:
        fault = self.plan[self.questions % len(self.plan)]
        self.questions += 1
        if isinstance(message, BatteryVoltageRead):
            reply: Message = BatteryVoltage(self.questions)
            size = 6
        elif isinstance(message, ServoPositionsRead):
            servos = message.servo_ids[fault.left_out :]
            reply = ServoPositions([(servo, self.questions) for servo in servos])
            size = 5 + 3 * len(message.servo_ids)
        else:
            return
        allowed = REPLY_TIMEOUT + size / 960
        for report in fault.reports:
            self.reported.append(report)
            yield 0.0, report.encode()
        if not fault.dropped:
            frame = reply.encode()
            at = fault.late * allowed
            yield at, fault.before + frame[: fault.cut]
            yield at + fault.gap * (fault.late < 1), frame[fault.cut :] + fault.after


@given(
    st.lists(faults, min_size=1, max_size=12),
    st.lists(asks, min_size=1, max_size=12),
    st.integers(0, 2),
)
def test_every_call_returns_the_right_value_or_an_error_in_bounded_time(
    plan: list[Fault], questions: list[list[int] | None], retries: int
) -> None:
    board = FaultyBoard(plan)
    line = VirtualLine(board.answer)
    client = client_on(
        line, Controller, reply_timeout=REPLY_TIMEOUT, retries=retries, baud=9600, settle=None
    )
    for question in questions:
        before, began = board.questions, line.now
        try:
            if question is None:
                values = {client.read_battery_voltage()}
            else:
                positions = client.read_servo_positions(question)
                assert sorted(each.servo_id for each in positions) == sorted(question)
                values = {each.position for each in positions}
        except NoReplyError:
            values = set()
        except IncompleteReplyError as error:
            there = [each for each in error.arrived if isinstance(each, ServoPosition)]
            named = sorted([*(each.servo_id for each in there), *error.missing])
            values = (
                {each.position for each in there} if named == question_in_order(question) else {-1}
            )
        # Every value was sent for this very call, be it to an earlier attempt of it.
        assert values <= set(range(before + 1, board.questions + 1))
        most = REPLY_TIMEOUT + 40 / 960
        assert line.now - began <= most * (retries + 1) + 2 * most
    # Nothing that was reported is lost, whatever became of the replies.
    assert list(client.reports(timeout=3)) == board.reported
    assert client.counters.lost_reports == 0
    client.close()
    assert line.closed


@given(
    st.lists(st.sampled_from([b"\x55", b"\x55\x55", b"\x55\x55\x15"]), max_size=40), st.booleans()
)
def test_a_board_that_sends_nothing_but_headers_ends_in_an_error(
    spurious: list[bytes], flood: bool
) -> None:
    line = VirtualLine()
    for at, data in enumerate(spurious):
        line.say(data * (40 if flood else 1), 0.02 * at)
    client = client_on(line, Controller, reply_timeout=REPLY_TIMEOUT, settle=None)
    with pytest.raises(NoReplyError) as caught:
        client.read_battery_voltage()
    assert caught.value.waited <= 1
    assert line.now <= 1
    client.close()


def test_a_flood_of_reports_hides_no_reply() -> None:
    def answer(message: Message) -> Iterator[tuple[float, bytes]]:
        for at in range(30):
            yield at * 0.007, REPORTS[2].encode()
            if at == 20:
                yield at * 0.007, BatteryVoltage(7500).encode()

    line = VirtualLine(answer)
    client = client_on(line, Controller, report_limit=16, settle=None)
    assert client.read_battery_voltage() == 7500
    kept = list(client.reports(timeout=1))
    # The queue holds 16; the oldest went, and were counted.
    assert len(kept) + client.counters.lost_reports == 30
    assert client.counters.lost_reports >= 21 - 16
    client.close()


def test_a_soak_with_faults() -> None:
    seen = 0

    def answer(message: Message) -> Iterator[tuple[float, bytes]]:
        nonlocal seen
        seen += 1
        if seen % 7 == 0:
            return
        if seen % 5 == 0:
            yield 0.0, b"\x55\x00" + REPORTS[seen % 3].encode()
        yield 0.3 if seen % 11 == 0 else 0.01, BatteryVoltage(seen % 65536).encode()

    line = VirtualLine(answer)
    client = client_on(line, Controller, baud=math.inf, settle=None)
    failed = reports = 0
    for _ in range(1000):
        before = seen
        try:
            value = client.read_battery_voltage()
        except NoReplyError:
            failed += 1
        else:
            assert value == seen == before + 1
    reports = len(list(client.reports(timeout=1)))
    assert reports + client.counters.lost_reports == sum(
        1 for n in range(1, seen + 1) if n % 5 == 0 and n % 7
    )
    assert (
        failed
        == client.counters.timeouts
        == sum(1 for n in range(1, seen + 1) if n % 7 == 0 or n % 11 == 0)
    )
    client.close()
