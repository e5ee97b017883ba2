"""No wrong value is ever returned: the right reply or a declared error, in bounded time.

With every fault, by seeded schedules, for threads and for asyncio, in this process in virtual time.
tests/world/test_conversations_on_lines.py has a few over pseudo-terminals and TCP, in real time.
"""

import asyncio
import math
from dataclasses import replace
from functools import partial
from typing import Any

import pytest
from busservo import AsyncController, Controller
from busservo_simulator import Faults, VirtualClock, VirtualController
from framewire.simulator.virtual_loop import run_virtual
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.lines.at_board import client_at, virtual_board
from tests.lines.conversation import FAULTS, Ledger, converse, converse_async

REPLY_TIMEOUT = 0.25
# A reply may come long after its request has timed out, but not so late that nothing could tell it
# from the next: that is after as long again. In pieces, it takes a little longer.
LATE = 1.7 * REPLY_TIMEOUT
# A question waits for the late reply of the one before, for twice as long as that was given, and
# then for its own; the clock counts in floats.
MOST = 3 * REPLY_TIMEOUT + 1e-6

chance = st.sampled_from([0.0, 0.0, 0.1, 0.3, 0.7])


schedules = st.builds(
    Faults,
    seed=st.integers(0, 2**32),
    longest_delay=st.sampled_from([0.01, LATE / 2, LATE]),
    **dict.fromkeys(
        ["noise", "splits", "coalesced", "delays", "dropped", "fewer", "absent", "unsolicited"],
        chance,
    ),
    splits_to_board=chance,
)
LINE: dict[str, Any] = {"baud": math.inf, "reply_timeout": REPLY_TIMEOUT, "settle": None}


def virtual(faults: Faults) -> tuple[VirtualController, Ledger, VirtualClock]:
    board = virtual_board(faults=faults)
    clock = board.clock
    assert isinstance(clock, VirtualClock)
    return board, Ledger(board), clock


@given(schedules, st.integers(0, 2**32), st.integers(0, 2))
def test_answers_and_reports_are_right_under_any_schedule_of_faults(
    faults: Faults, seed: int, retries: int
) -> None:
    board, ledger, clock = virtual(faults)
    with board, client_at(board, Controller, **LINE, retries=retries) as controller:
        converse(controller, ledger, seed, 15, clock.now, bound=MOST + retries * REPLY_TIMEOUT)
        assert list(controller.reports(timeout=1)) == ledger.reported
        assert controller.counters.lost_reports == 0


@given(schedules, st.integers(0, 2**32), st.integers(0, 2), st.sampled_from([0.0, 0.05]))
def test_answers_and_reports_are_right_under_any_schedule_of_faults_with_asyncio(
    faults: Faults, seed: int, retries: int, cut: float
) -> None:
    """Three tasks share the client, or one where the line is cut, which opens it again."""
    faults = replace(faults, hang_up=cut, splits_to_board=0 if cut else faults.splits_to_board)
    board, ledger, clock = virtual(faults)

    async def work() -> None:
        async with client_at(board, AsyncController, **LINE, retries=retries) as controller:
            tasks, turns = (1, 15) if cut else (3, 5)
            # Each may have to wait for all that the others ask.
            questions = 1 + (tasks - 1) * turns
            bound = questions * (MOST + retries * REPLY_TIMEOUT) + 0.001
            talks = (
                converse_async(controller, ledger, seed + task, turns, clock.now, bound)
                for task in range(tasks)
            )
            await asyncio.gather(*talks)
            if not cut:
                received = [report async for report in controller.reports(timeout=1)]
                assert received == ledger.reported
                assert controller.counters.lost_reports == 0

    with board:
        run_virtual(work(), clock)


@pytest.mark.garbage
@given(st.integers(0, 2**32), st.sampled_from([0.02, 0.1]))
def test_requests_that_arrive_damaged_give_no_wrong_value(seed: int, flips: float) -> None:
    board, ledger, clock = virtual(Faults(seed=seed, bit_flips_to_board=flips, noise_to_board=0.5))
    with board, client_at(board, Controller, **LINE) as controller:
        converse(controller, ledger, seed, 15, clock.now, bound=MOST)


@in_turn("seed", lambda: range(4))
def test_a_hundred_tasks_share_a_line_with_faults(seed: int) -> None:
    board, ledger, clock = virtual(replace(FAULTS["mixed"], seed=seed))

    async def work() -> None:
        async with client_at(board, AsyncController, baud=math.inf, settle=None) as controller:
            talk = partial(converse_async, controller, ledger, now=clock.now, bound=math.inf)
            await asyncio.gather(*(talk(seed=each, count=1) for each in range(100)))
            received = [report async for report in controller.reports(timeout=1)]
            assert received == ledger.reported

    with board:
        run_virtual(work(), clock)
        assert ledger.right >= 40
