"""A soak: a hundred thousand calls to a virtual board, with faults all the while.

    python -m tests.soak [--requests N] [--rounds N] [--seed S]

In virtual time; by eight threads over TCP; and by a hundred tasks of asyncio over TCP. Then the
independent board, as often: see tests/contract/independent/long_run.py; and a bus of servos, one of
them dead: see tests/lines/long_bus_run.py. Every value that comes back must be
the right one, or a declared error, in bounded time; every report must come, in order; and in the
end no more memory, threads and pending messages may be there than after the first fifth.
It is no part of `make test`, which only tries that it runs.
"""

import argparse
import asyncio
import math
import threading
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

from busservo import AsyncController, Controller, Message, open_transport
from busservo_simulator import Faults, VirtualController

from tests.contract.independent import long_run
from tests.lines.at_board import client_at, virtual_board
from tests.lines.conversation import (
    Ledger,
    converse,
    converse_async,
    reports_received,
    reports_received_async,
)
from tests.lines.growth import Growth
from tests.lines.long_bus_run import on_a_bus
from tests.timeouts import GENEROUS, await_that

THREADS, TASKS = 8, 100
REPLY_TIMEOUT = 0.25
# The other end is a thread of the same busy machine.
LIVE_REPLY_TIMEOUT = 1.0
# So that rounds end soon although a lost reply costs twice the reply timeout. No frame comes in
# pieces: a busy machine may hold one up for so long that the frame is lost, and its report with it.
LIVE = {"noise": 0.1, "coalesced": 0.002, "delays": 0.002, "dropped": 0.0005}
LIVE["longest_delay"] = 0.1
VIRTUAL = {"noise": 0.2, "splits": 0.2, "coalesced": 0.1, "delays": 0.2, "dropped": 0.1}
# Later than a request waits for its reply, but not than the next one of its kind does.
VIRTUAL["longest_delay"] = 0.4
BOTH = {"fewer": 0.05, "absent": 0.05, "unsolicited": 0.2}


class Watch:
    """A check that nothing is lost, and that nothing grows from round to round."""

    def __init__(self, name: str, ledger: Ledger, client: Controller | AsyncController) -> None:
        self._ledger = ledger
        self._client = client
        self._growth = Growth(name)

    def round(self, done: int, received: Sequence[Message]) -> None:
        """End a round: so many requests in all, and these reports since the round before."""
        ledger, session = self._ledger, self._client._session
        assert list(received) == ledger.reported, "a report was lost"
        ledger.reported.clear()
        assert session.idle
        # Another thread may have a report in hand, for callbacks.
        await_that(lambda: not session.callback_queue)
        assert len(session._matcher.late) < THREADS
        assert session.reports.take() is None
        assert session.counters.lost_reports == 0
        assert ledger.board.rejects.total == 0
        self._growth.round(done)

    def end(self, requests: int) -> None:
        """Print the result. Raises AssertionError if something has grown."""
        right, refused, counters = self._ledger.right, self._ledger.refused, self._client.counters
        result = f"{right} answered rightly, {refused} ended in a declared error"
        self._growth.end(requests, f"{result}, {counters.lost_reports} lost: {counters}")


def in_virtual_time(requests: int, rounds: int, seed: int) -> None:
    """Run one thread, in this process: the board's time is moved on, and nothing sleeps."""
    with virtual_board(faults=Faults(seed=seed, **VIRTUAL, **BOTH)) as board:
        ledger = Ledger(board)
        with client_at(
            board, Controller, baud=math.inf, reply_timeout=REPLY_TIMEOUT, settle=None
        ) as controller:
            watch = Watch("virtual time", ledger, controller)
            for turn in range(rounds):
                size = requests // rounds
                bound = 3 * REPLY_TIMEOUT + 0.001
                converse(controller, ledger, seed + turn, size, board.clock.now, bound)
                watch.round((turn + 1) * size, list(controller.reports(timeout=1)))
            watch.end(requests)


def with_threads(requests: int, rounds: int, seed: int) -> None:
    """Run eight threads that share a controller."""
    faults = Faults(seed=seed, **LIVE, **BOTH)
    with VirtualController("tcp", faults=faults) as board, ThreadPoolExecutor(THREADS) as pool:
        ledger = Ledger(board)
        # A pool starts a thread only when none is idle: all are there before the first round.
        begun = threading.Barrier(THREADS)
        list(pool.map(lambda _: begun.wait(GENEROUS), range(THREADS)))
        transport = open_transport(board.port)
        with Controller(transport, baud=math.inf, reply_timeout=LIVE_REPLY_TIMEOUT) as controller:
            watch = Watch(f"{THREADS} threads", ledger, controller)
            size = requests // rounds // THREADS
            for turn in range(rounds):
                seeds = range(seed + turn * THREADS, seed + (turn + 1) * THREADS)
                list(pool.map(lambda each: converse(controller, ledger, each, size), seeds))
                watch.round((turn + 1) * size * THREADS, reports_received(controller, ledger))
            watch.end(size * THREADS * rounds)


async def with_tasks(requests: int, rounds: int, seed: int) -> None:
    """Run a hundred tasks that share a controller."""
    faults = Faults(seed=seed, **LIVE, **BOTH)
    with VirtualController("tcp", faults=faults) as board:
        ledger = Ledger(board)
        transport = open_transport(board.port)
        async with AsyncController(
            transport, baud=math.inf, reply_timeout=LIVE_REPLY_TIMEOUT
        ) as controller:
            watch = Watch(f"{TASKS} tasks", ledger, controller)
            size = requests // rounds // TASKS
            for turn in range(rounds):
                seeds = range(seed + turn * TASKS, seed + (turn + 1) * TASKS)
                talks = (converse_async(controller, ledger, each, size) for each in seeds)
                await asyncio.gather(*talks)
                received = await reports_received_async(controller, ledger)
                watch.round((turn + 1) * size * TASKS, received)
            watch.end(size * TASKS * rounds)


def main(words: Sequence[str] | None = None) -> None:
    """Soak all six ways. Raises AssertionError at the first thing that is wrong."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--requests", type=int, default=100_000, help="for each (default: 100000)")
    parser.add_argument("--rounds", type=int, default=50, help="after each, all is looked at")
    parser.add_argument("--seed", type=int, default=1, help="of the faults (default: 1)")
    arguments = parser.parse_args(words)
    run = arguments.requests, arguments.rounds, arguments.seed
    in_virtual_time(*run)
    with_threads(*run)
    asyncio.run(with_tasks(*run))
    long_run.at_a_paced_line(*run)
    long_run.with_threads(*run)
    on_a_bus(*run)


if __name__ == "__main__":
    main()
