"""No wrong value is ever returned: the right reply or a declared error, in bounded time.

With every fault, by seeded schedules, for threads and for asyncio: in this process in virtual time
by the hundred, and a few over pseudo-terminals, TCP and memory in real time.
"""

from __future__ import annotations

import asyncio
import math
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from busservo import AsyncController, Controller, open_async_controller, open_controller
from busservo_simulator import Faults, VirtualClock, VirtualController
from busservo_simulator.virtual_loop import run_virtual
from hypothesis import given
from hypothesis import strategies as st

from tests import soak
from tests.at_once import at_once
from tests.client.conversation import (
    Ledger,
    converse,
    converse_async,
    reports_received,
    reports_received_async,
)

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractAsyncContextManager
    from pathlib import Path

    from tests.timeouts import Line

WAYS = ["memory", "tcp"] if sys.platform == "win32" else ["memory", "tcp", "pty"]
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
    noise=chance,
    splits=chance,
    coalesced=chance,
    delays=chance,
    dropped=chance,
    fewer=chance,
    absent=chance,
    unsolicited=chance,
    longest_delay=st.sampled_from([0.01, LATE / 2, LATE]),
    splits_to_board=chance,
)


def virtual(faults: Faults) -> tuple[VirtualController, Ledger, VirtualClock]:
    clock = VirtualClock(follow_reads=True)
    board = VirtualController(clock=clock, faults=faults)
    return board, Ledger(board), clock


@given(schedules, st.integers(0, 2**32), st.integers(0, 2))
def test_answers_and_reports_are_right_under_any_schedule_of_faults(
    faults: Faults, seed: int, retries: int
) -> None:
    board, ledger, clock = virtual(faults)
    with (
        board,
        Controller(
            board.transport,
            background=False,
            clock=clock.now,
            baud=math.inf,
            reply_timeout=REPLY_TIMEOUT,
            retries=retries,
        ) as controller,
    ):
        converse(controller, ledger, seed, 15, clock.now, bound=MOST + retries * REPLY_TIMEOUT)
        assert list(controller.reports(timeout=1)) == ledger.reported
        assert controller.counters.lost_reports == 0


@given(schedules, st.integers(0, 2**32), st.floats(0.01, 0.3))
def test_a_line_that_is_cut_in_mid_frame_comes_back(faults: Faults, seed: int, cut: float) -> None:
    board, ledger, clock = virtual(replace(faults, hang_up=cut, splits_to_board=0))
    with (
        board,
        Controller(
            board.transport,
            background=False,
            clock=clock.now,
            baud=math.inf,
            reply_timeout=REPLY_TIMEOUT,
        ) as controller,
    ):
        converse(controller, ledger, seed, 15, clock.now, bound=MOST)
        # A cut may be due yet, behind a frame that is late.
        board.faults = replace(faults, hang_up=0)
        board.advance(2 * REPLY_TIMEOUT)
        board.plug_in()
        controller.reconnect()
        received = list(controller.reports(timeout=1))
        # What was under way when the line was cut is lost; nothing else is, and nothing is made up.
        rest: Iterator[object] = iter(ledger.reported)
        assert all(report in rest for report in received)


@given(schedules, st.integers(0, 2**32), st.integers(0, 2), st.sampled_from([0.0, 0.05]))
def test_answers_and_reports_are_right_under_any_schedule_of_faults_with_asyncio(
    faults: Faults, seed: int, retries: int, cut: float
) -> None:
    """Three tasks share the client, or one where the line is cut, which opens it again."""
    faults = replace(faults, hang_up=cut, splits_to_board=0 if cut else faults.splits_to_board)
    board, ledger, clock = virtual(faults)

    async def work() -> None:
        async with AsyncController(
            board.transport,
            background=False,
            clock=clock.now,
            baud=math.inf,
            reply_timeout=REPLY_TIMEOUT,
            retries=retries,
        ) as controller:
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
    with (
        board,
        Controller(
            board.transport,
            background=False,
            clock=clock.now,
            baud=math.inf,
            reply_timeout=REPLY_TIMEOUT,
        ) as controller,
    ):
        converse(controller, ledger, seed, 15, clock.now, bound=MOST)


# -------------------------------------------------------------------- live


# No frame comes to the client in pieces: a busy machine would hold up the second one for so long
# that the frame is lost, as on a line that is quiet within a frame. In virtual time, they do.
FAULTS = {
    "mixed": Faults(
        noise=0.3,
        coalesced=0.2,
        delays=0.3,
        dropped=0.05,
        fewer=0.1,
        absent=0.1,
        unsolicited=0.5,
        longest_delay=0.05,
        splits_to_board=0.3,
    ),
    "cut": Faults(noise=0.2, unsolicited=0.3, hang_up=0.08),
}
# As if on a slow machine, where an answer takes its time; each lost one costs twice as much.
LIVE_REPLY_TIMEOUT = 0.5


@contextmanager
def board_at(way: str, folder: Path, faults: Faults) -> Iterator[tuple[VirtualController, Ledger]]:
    folder.mkdir(exist_ok=True)
    link = folder / "board" if way == "pty" else None
    with VirtualController(way, faults=faults, link=link) as board:  # type: ignore[arg-type]
        yield board, Ledger(board)


def line_at(way: str) -> Line:
    """Return the client's settings: a line that takes no time, as it does; over TCP, a slow one."""
    baud = 9600 if way == "tcp" else math.inf
    return {"reply_timeout": LIVE_REPLY_TIMEOUT, "baud": baud, "settle": 0}


def opened(board: VirtualController, way: str) -> Controller:
    if way == "memory":
        return Controller(board.transport, **line_at(way))
    return open_controller(board.port, **line_at(way))


def opened_async(
    board: VirtualController, way: str
) -> AbstractAsyncContextManager[AsyncController]:
    if way == "memory":
        return AsyncController(board.transport, **line_at(way))
    return open_async_controller(board.port, **line_at(way))


LINES = [(way, kind) for way in WAYS for kind in FAULTS]
# With each of them, the line is cut once or twice, or one reply is lost, or none over TCP, where
# the client doubts most replies: each of these costs the better part of a second.
SEEDS = {"memory": (6, 5), "tcp": (2, 2), "pty": (6, 5)}


def faults_at(way: str, kind: str) -> Faults:
    mixed, cut = SEEDS[way]
    return replace(FAULTS[kind], seed=cut if kind == "cut" else mixed)


def test_answers_and_reports_are_right_over_a_live_line(tmp_path: Path) -> None:
    def talk(way: str, kind: str) -> None:
        faults = faults_at(way, kind)
        with board_at(way, tmp_path / kind, faults) as (board, ledger):
            with opened(board, way) as controller:
                converse(controller, ledger, faults.seed, 12)
                if kind == "mixed":
                    assert reports_received(controller, ledger) == ledger.reported
                assert controller.counters.lost_reports == 0
            assert ledger.right >= 3
            assert (ledger.reconnected > 0) == (kind == "cut")

    at_once(talk, LINES)


def test_answers_and_reports_are_right_over_a_live_line_with_asyncio(tmp_path: Path) -> None:
    def talk(way: str, kind: str) -> None:
        faults = faults_at(way, kind)
        with board_at(way, tmp_path / kind, faults) as (board, ledger):

            async def work() -> None:
                async with opened_async(board, way) as controller:
                    await converse_async(controller, ledger, faults.seed, 12)
                    if kind == "mixed":
                        assert await reports_received_async(controller, ledger) == ledger.reported
                    assert controller.counters.lost_reports == 0

            asyncio.run(work())
            assert ledger.right >= 3
            assert (ledger.reconnected > 0) == (kind == "cut")

    at_once(talk, LINES)


def test_eight_threads_share_a_line_with_faults(tmp_path: Path) -> None:
    def talk(way: str, kind: str) -> None:
        seed = {"memory": 6, "tcp": 8, "pty": 2}[way]
        with board_at(way, tmp_path, replace(FAULTS[kind], seed=seed)) as (board, ledger):
            with opened(board, way) as controller, ThreadPoolExecutor(8) as pool:
                list(pool.map(lambda seed: converse(controller, ledger, seed, 3), range(8)))
                assert reports_received(controller, ledger) == ledger.reported
            assert ledger.right >= 5

    at_once(talk, [(way, "mixed") for way in WAYS])


@pytest.mark.parametrize("seed", range(4))
def test_a_hundred_tasks_share_a_line_with_faults(seed: int) -> None:
    board, ledger, clock = virtual(replace(FAULTS["mixed"], seed=seed))

    async def work() -> None:
        async with AsyncController(
            board.transport, background=False, clock=clock.now, baud=math.inf
        ) as controller:
            talks = (
                converse_async(controller, ledger, each, 1, clock.now, math.inf)
                for each in range(100)
            )
            await asyncio.gather(*talks)
            received = [report async for report in controller.reports(timeout=1)]
            assert received == ledger.reported

    with board:
        run_virtual(work(), clock)
        assert ledger.right >= 40


@pytest.mark.slow
def test_the_soak_runs(capsys: pytest.CaptureFixture[str]) -> None:
    """In short; `make soak` asks a hundred thousand times."""
    soak.main(["--requests", "200", "--rounds", "2"])
    assert capsys.readouterr().out.count(" 0 lost") == 5
